/* Bridges of a packing in YADE: the loop over neighbours, from a table. Called by pendular_yade.py, see docs/yade.md.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#include "pendular_table.h"

/* Why a step was not made; else 0. */
enum { OUT_OF_RANGE = 1 };

size_t pendular_yade_size(void);
int pendular_yade_open(const char *path, pendular_table *table);
void pendular_yade_close(pendular_table *table);
const char *pendular_yade_error(int code);
void pendular_yade_about(const pendular_table *table, double *numbers);
double pendular_yade_value(const pendular_table *table, int asked, double separation, double control, double radius1,
    double radius2, double surface_tension);
int pendular_yade_step(const pendular_table *grains, const pendular_table *walls, double control,
    double surface_tension, int forms_apart, int is_periodic, size_t pairs, const int32_t *first, const int32_t *second,
    const double *beside, unsigned char *has_bridge, size_t bodies, const double *places, const double *radius,
    const signed char *axis, double *forces, double *separation, double *attraction, size_t *place);

size_t pendular_yade_size(void)
{
    return sizeof(pendular_table);
}

int pendular_yade_open(const char *path, pendular_table *table)
{
    return pendular_table_open(path, table);
}

void pendular_yade_close(pendular_table *table)
{
    pendular_table_close(table);
}

const char *pendular_yade_error(int code)
{
    return pendular_table_error(code);
}

/* Whether the volume is held, the number of sides, and the ranges that were asked. */
void pendular_yade_about(const pendular_table *table, double *numbers)
{
    numbers[0] = table->is_volume;
    numbers[1] = table->sides;
    memcpy(numbers + 2, table->reduced, sizeof table->reduced);
    memcpy(numbers + 4, table->radius_ratio, sizeof table->radius_ratio);
}

double pendular_yade_value(const pendular_table *table, int asked, double separation, double control, double radius1,
    double radius2, double surface_tension)
{
    return pendular_table_value(table, asked, separation, control, radius1, radius2, surface_tension);
}

/* Separation of a pair, and the unit vector from the first to the second; a wall is a plane across its axis. In a periodic
   cell the second is moved by `beside`, else that is NULL. */
static double apart(size_t bodies, const double *places, const double *radius, const signed char *axis, int32_t i,
    int32_t j, const double *beside, double *towards)
{
    double length, sum = 0.0;
    int k;
    for (k = 0; k < 3; ++k) {
        towards[k] = axis[j] < 0 || axis[j] == k ? places[k * bodies + j] - places[k * bodies + i] : 0.0;
        if (beside)
            towards[k] += beside[k];
        sum += towards[k] * towards[k];
    }
    length = sqrt(sum);
    for (k = 0; k < 3; ++k)
        towards[k] /= length;
    return length - radius[i] - (axis[j] < 0 ? radius[j] : 0.0);
}

/* Add the forces of all bridges; a pair that touches gets one, and one that broke has none. `place` is the pair that is
   out of range. */
int pendular_yade_step(const pendular_table *grains, const pendular_table *walls, double control,
    double surface_tension, int forms_apart, int is_periodic, size_t pairs, const int32_t *first, const int32_t *second,
    const double *beside, unsigned char *has_bridge, size_t bodies, const double *places, const double *radius,
    const signed char *axis, double *forces, double *separation, double *attraction, size_t *place)
{
    size_t n;
    int k;
    for (n = 0; n < pairs; ++n) {
        const int32_t i = first[n], j = second[n];
        const pendular_table *table = axis[j] < 0 ? grains : walls;
        double towards[3], pull;
        const double gap = apart(bodies, places, radius, axis, i, j, is_periodic ? beside + 3 * n : NULL, towards);
        separation[n] = gap;
        attraction[n] = 0.0;
        if (!has_bridge[n] && gap > 0.0 && !forms_apart)
            continue;
        pull = pendular_table_force(table, gap, control, radius[i], axis[j] < 0 ? radius[j] : INFINITY, surface_tension);
        if (pull != pull) {
            *place = n;
            return OUT_OF_RANGE;
        }
        has_bridge[n] = gap <= 0.0 || pull != 0.0;
        attraction[n] = pull;
        for (k = 0; k < 3; ++k) {
            forces[k * bodies + i] += pull * towards[k];
            forces[k * bodies + j] -= pull * towards[k];
        }
    }
    return 0;
}
