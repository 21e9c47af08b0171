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
int pendular_yade_exchange(const pendular_table *grains, const pendular_table *walls, double most, double share,
    double surface_tension, int forms_apart, int is_periodic, size_t pairs, const int32_t *first, const int32_t *second,
    const double *beside, unsigned char *has_bridge, double *volumes, size_t bodies, const double *places,
    const double *radius, const signed char *axis, double *film, double *offer, size_t *place);
int pendular_yade_step(const pendular_table *grains, const pendular_table *walls, double control,
    double surface_tension, int forms_apart, int is_periodic, size_t pairs, const int32_t *first, const int32_t *second,
    const double *beside, unsigned char *has_bridge, const double *volumes, size_t bodies, const double *places,
    const double *radius, const signed char *axis, double *forces, double *separation, double *attraction, size_t *place);

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

/* What the exchange of liquid looks at: pairs and grains, as they are handed over. */
typedef struct {
    const pendular_table *grains, *walls;
    double most, share, surface_tension;
    const int32_t *first, *second;
    const double *beside, *places, *radius;
    const signed char *axis;
    size_t bodies;
} Heap;

static double gap_of(const Heap *heap, size_t n)
{
    double towards[3];
    return apart(heap->bodies, heap->places, heap->radius, heap->axis, heap->first[n], heap->second[n],
        heap->beside ? heap->beside + 3 * n : NULL, towards);
}

static int is_wall(const Heap *heap, size_t n)
{
    return heap->axis[heap->second[n]] >= 0;
}

/* Rupture distance of a pair with so much liquid; NaN if its table does not know it. */
static double end_of(const Heap *heap, size_t n, double volume)
{
    const double other = is_wall(heap, n) ? INFINITY : heap->radius[heap->second[n]];
    return pendular_table_rupture_distance(is_wall(heap, n) ? heap->walls : heap->grains, volume,
        heap->radius[heap->first[n]], other, heap->surface_tension);
}

/* The liquid of a bridge that broke, back to its grains. */
static void give_back(const Heap *heap, size_t n, double volume, double *film)
{
    film[heap->first[n]] += is_wall(heap, n) ? volume : 0.5 * volume;
    film[heap->second[n]] += is_wall(heap, n) ? 0.0 : 0.5 * volume;
}

/* A new bridge takes at most so much, in proportion to what its grains offer; whether it forms, or -1 out of range. */
static int take(const Heap *heap, size_t n, const double *offer, double *film, double *volume)
{
    const int32_t i = heap->first[n], j = heap->second[n];
    const double others = is_wall(heap, n) ? 0.0 : offer[j], sum = offer[i] + others;
    const double held = sum < heap->most ? sum : heap->most;
    const double end = held > 0.0 ? end_of(heap, n, held) : 0.0;
    if (end != end && held == heap->most)
        return -1;
    if (!(end > 0.0 && gap_of(heap, n) < end)) /* or too little for the table */
        return 0;
    *volume = held;
    film[i] -= held * (offer[i] / sum);
    film[j] -= held * (others / sum);
    return 1;
}

/* Liquid between the films on the grains and the bridges: one that broke leaves half of it on each grain, and all of it on
   a grain at a wall; what a grain offers, a share of its film, is parted evenly among the bridges that form on it. `offer`
   is room for a number of each body. */
int pendular_yade_exchange(const pendular_table *grains, const pendular_table *walls, double most, double share,
    double surface_tension, int forms_apart, int is_periodic, size_t pairs, const int32_t *first, const int32_t *second,
    const double *beside, unsigned char *has_bridge, double *volumes, size_t bodies, const double *places,
    const double *radius, const signed char *axis, double *film, double *offer, size_t *place)
{
    enum { NONE = 0, STANDS = 1, FORMS = 2 };
    const Heap heap = { grains, walls, most, share, surface_tension, first, second, is_periodic ? beside : NULL, places,
        radius, axis, bodies };
    size_t n;
    memset(offer, 0, bodies * sizeof *offer);
    for (n = 0; n < pairs; ++n) {
        const double gap = gap_of(&heap, n);
        if (has_bridge[n] != NONE && !(gap < end_of(&heap, n, volumes[n]))) {
            give_back(&heap, n, volumes[n], film);
            volumes[n] = 0.0;
            has_bridge[n] = NONE;
        } else if (has_bridge[n] == NONE && (gap <= 0.0 || (forms_apart && gap < end_of(&heap, n, most)))) {
            has_bridge[n] = FORMS;
            offer[first[n]] += 1.0;
            offer[second[n]] += 1.0;
        }
    }
    for (n = 0; n < bodies; ++n)
        offer[n] = offer[n] > 0.0 && film[n] > 0.0 ? share * film[n] / offer[n] : 0.0;
    for (n = 0; n < pairs; ++n) {
        int forms;
        if (has_bridge[n] != FORMS)
            continue;
        forms = take(&heap, n, offer, film, volumes + n);
        if (forms < 0) {
            *place = n;
            return OUT_OF_RANGE;
        }
        has_bridge[n] = forms ? STANDS : NONE;
    }
    return 0;
}

/* Add the forces of all bridges; a pair that touches gets one, if bridges take no liquid from films, and one that broke has
   none. `volumes` are those of the bridges, or NULL. `place` is the pair that is out of range. */
int pendular_yade_step(const pendular_table *grains, const pendular_table *walls, double control,
    double surface_tension, int forms_apart, int is_periodic, size_t pairs, const int32_t *first, const int32_t *second,
    const double *beside, unsigned char *has_bridge, const double *volumes, size_t bodies, const double *places,
    const double *radius, const signed char *axis, double *forces, double *separation, double *attraction, size_t *place)
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
        if (!has_bridge[n] && (volumes || (gap > 0.0 && !forms_apart)))
            continue;
        pull = pendular_table_force(table, gap, volumes ? volumes[n] : control, radius[i],
            axis[j] < 0 ? radius[j] : INFINITY, surface_tension);
        if (pull != pull) {
            *place = n;
            return OUT_OF_RANGE;
        }
        has_bridge[n] = volumes || gap <= 0.0 || pull != 0.0;
        attraction[n] = pull;
        for (k = 0; k < 3; ++k) {
            forces[k * bodies + i] += pull * towards[k];
            forces[k * bodies + j] -= pull * towards[k];
        }
    }
    return 0;
}
