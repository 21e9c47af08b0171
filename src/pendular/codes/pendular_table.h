/* Capillary bridges between two solids, read from a table: one header for C99, C++11, CUDA, HIP and WebAssembly.

   A table holds the exact solution of the Young-Laplace equation for one pair of contact angles, at constant suction or
   at constant volume of the liquid, as polynomials. `pendular export table` writes it to a file, whose bytes are told in
   docs/reference/table_format.md; `pendular export c` writes its numbers into a header together with this text.

     pendular_table table;
     int code = pendular_table_open("w.bridges", &table);
     if (code != PENDULAR_TABLE_OK)
         fprintf(stderr, "%s\n", pendular_table_error(code));
     force = pendular_table_force(&table, separation, suction, radius1, radius2, surface_tension);
     ...
     pendular_table_close(&table);

   SI units, or any one consistent set. The separation is from surface to surface; a plane has radius INFINITY. If the two
   contact angles differ, radius1 belongs to the first. The control is the suction (gas pressure minus liquid pressure), or
   the volume, if table.is_volume.

   From the rupture distance on, force and energy are exactly 0; all else is NaN, as there is no bridge. Solids that
   overlap, of negative separation, have the bridge of solids that touch; its stiffness is 0. Outside the range of the
   table, and where an argument is NaN, or a radius or the surface tension not positive, all answers are NaN. There is no
   memory: whether a bridge has formed, or has broken before, is for the caller to know.

   An open table is never written to, so that any number of threads may ask it at once.

   Before it is included, PENDULAR_TABLE_NO_FILES leaves out what opens a file by its path, and needs stdio.h and stdlib.h.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#ifndef PENDULAR_TABLE_H
#define PENDULAR_TABLE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#ifndef PENDULAR_TABLE_NO_FILES
#include <stdio.h>
#include <stdlib.h>
#endif

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "NaN marks what is out of range: compile without -ffast-math, or add -fno-finite-math-only"
#endif

#define PENDULAR_HOST static inline
#if defined(__CUDACC__) || defined(__HIPCC__)
#define PENDULAR_FUNCTION static inline __host__ __device__
#else
#define PENDULAR_FUNCTION static inline
#endif

/* Answers of a table: a channel by its number, or what follows from channels. */
enum {
    PENDULAR_TABLE_RUPTURE_DISTANCE = 0, /* [m] */
    PENDULAR_TABLE_FORCE = 1,            /* attraction [N] */
    PENDULAR_TABLE_LIQUID = 2,           /* volume [m3] under suction, suction [Pa] at constant volume */
    PENDULAR_TABLE_STIFFNESS = -1,       /* dF/dD with the control held [N/m] */
    PENDULAR_TABLE_ENERGY = -2           /* potential E with F = dE/dD: minus the work that breaks the bridge [J] */
};

/* Sizes: of a polynomial, and of the parts of a file. */
enum {
    PENDULAR_TABLE_LANES = 8, /* powers of the last variable, side by side */
    PENDULAR_TABLE_PAIR_TERMS = 8,
    PENDULAR_TABLE_CONTROL_TERMS = 5, /* powers x^i y^j with i + j < 6 */
    PENDULAR_TABLE_FEWEST_SIZE_TERMS = 2,
    PENDULAR_TABLE_PAIR_CELL = 64,    /* coefficients */
    PENDULAR_TABLE_BRIDGE_CELL = 160,
    PENDULAR_TABLE_MOST_CHANNELS = 16,
    PENDULAR_TABLE_HEADER = 176, /* bytes */
    PENDULAR_TABLE_CHANNEL = 112,
    PENDULAR_TABLE_ALIGNMENT = 64,
    PENDULAR_TABLE_CHECKSUM = 4,
    PENDULAR_TABLE_VERSION = 2
};

/* At constant volume q is stretched by the length d = PENDULAR_TABLE_STRETCH Rm sqrt(c), of 0.7 sqrt(2/pi). */
#define PENDULAR_TABLE_STRETCH 0.5585191925620058

/* Columns of the numbers of a row, and of its cuts. */
enum { PENDULAR_TABLE_X0, PENDULAR_TABLE_X1, PENDULAR_TABLE_U0, PENDULAR_TABLE_U1, PENDULAR_TABLE_Q0, PENDULAR_TABLE_Q1,
    PENDULAR_TABLE_LINE };
enum { PENDULAR_TABLE_U_SHIFT, PENDULAR_TABLE_U_FIRST, PENDULAR_TABLE_U_COUNT, PENDULAR_TABLE_Q_SHIFT,
    PENDULAR_TABLE_Q_FIRST, PENDULAR_TABLE_Q_COUNT, PENDULAR_TABLE_SIZE_CELLS, PENDULAR_TABLE_CELLS, PENDULAR_TABLE_CUT };

/* A quantity: factor * surface_tension^tension * Rm^radius * c^(control/2) times a polynomial, with Rm = 2 R1 R2/(R1 + R2)
   and the reduced control c = suction Rm/surface_tension, or volume/Rm^3. */
typedef struct {
    const double *coefficients;
    double factor;
    double bound;          /* of its error; the file says relative to what */
    int32_t is_of_bridge;  /* 0: of the pair and the control alone, as the rupture distance */
    int32_t tension, radius, control;
} pendular_table_channel;

/* An open table. The first members are for the functions below; a copy of it is a table as well. */
typedef struct {
    const double *lines;  /* of each row: x0 and x1 of the control in its cell; u0 + u1 u and q0 + q1 q are cut */
    const int32_t *cuts;  /* of each row: how they are cut into cells, and the numbers of cells before those of the row */
    const double *units;  /* powers of two, by which the coefficients of a row are multiplied, for each channel; or NULL */
    pendular_table_channel channel[PENDULAR_TABLE_MOST_CHANNELS];
    double low, high, least_ratio, largest_ratio; /* of the control, and of the smaller over the larger radius */
    int32_t shift, first, rows, sides;            /* how the control is cut; two sides if the contact angles differ */
    int32_t channels, is_volume;
    double contact_angle[2];                /* [rad] */
    double reduced[2], radius_ratio[2];     /* ranges that were asked: of c, and of the larger over the smaller radius */
    double tolerance;                       /* error of the force over that at contact that was asked */
    const unsigned char *bytes;             /* of the file; NULL in a header with numbers */
    void *owned;                            /* memory to be freed */
} pendular_table;

/* Where a pair lies in a table, and where its bridge breaks; x is NaN out of range. */
typedef struct {
    int32_t row, size_cell;
    double control, x, y, radius, rupture; /* the control is reduced; radius is Rm */
    double bend;                           /* rupture over the length by which q is stretched; 0 under suction */
} pendular_table_place;

/* -- Cells ----------------------------------------------------------------------------------------------------------- */

PENDULAR_FUNCTION int64_t pendular_table_bits(double w)
{
    int64_t bits;
    memcpy(&bits, &w, sizeof bits);
    return bits;
}

PENDULAR_FUNCTION double pendular_table_number(int64_t bits)
{
    double w;
    memcpy(&w, &bits, sizeof w);
    return w;
}

/* Cells are equal parts of octaves of a number w, and are read off its bits; what lies beyond goes to the nearest. */
PENDULAR_FUNCTION int32_t pendular_table_cell(double w, int32_t shift, int32_t first, int32_t count)
{
    const int64_t cell = (pendular_table_bits(w) >> shift) - first;
    return (int32_t)(cell < 0 ? 0 : cell < count ? cell : count - 1);
}

/* Coordinate in a cell, from -1 to 1; that of a NaN is NaN. */
PENDULAR_FUNCTION double pendular_table_within(double w, int32_t shift)
{
    const uint64_t mantissa = (UINT64_C(1) << 52) - 1, one = UINT64_C(1023) << 52;
    const uint64_t bits = (((uint64_t)pendular_table_bits(w) << (52 - shift)) & mantissa) | one;
    return 2.0 * pendular_table_number((int64_t)bits) - 3.0 + (w - w);
}

/* Lower end of a cell. */
PENDULAR_FUNCTION double pendular_table_edge(int32_t cell, int32_t shift, int32_t first)
{
    return pendular_table_number(((int64_t)first + cell) << shift);
}

/* -- Polynomials ----------------------------------------------------------------------------------------------------- */

/* GCC makes vector instructions of these loops from -O3 on only, if it is not told how wide they are; others do. */
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__) && !defined(__HIPCC__)
#if defined(__AVX512F__)
#define PENDULAR_TABLE_WIDTH 8
#elif defined(__AVX__)
#define PENDULAR_TABLE_WIDTH 4
#else
#define PENDULAR_TABLE_WIDTH 2
#endif
typedef double pendular_table_vector
    __attribute__((vector_size(PENDULAR_TABLE_WIDTH * sizeof(double)), aligned(8), may_alias));
#define PENDULAR_TABLE_LOOP _Pragma("GCC unroll 8")
#else
#define PENDULAR_TABLE_WIDTH 1
typedef double pendular_table_vector;
#define PENDULAR_TABLE_LOOP
#endif

/* Polynomials in x and y, one for each of eight powers of the last variable: their coefficients lie side by side.
   The highest power of x has the fewest powers of y, each lower one has one more. */
PENDULAR_FUNCTION void pendular_table_lanes(
    const double *coefficients, int terms_x, int fewest_y, double x, double y, double *lanes)
{
    enum { parts = PENDULAR_TABLE_LANES / PENDULAR_TABLE_WIDTH };
    const pendular_table_vector *next = (const pendular_table_vector *)coefficients;
    pendular_table_vector of_x[parts], of_y[parts];
    int i, j, k;
    memset(of_x, 0, sizeof of_x);
    for (i = 0; i < terms_x; ++i) {
        PENDULAR_TABLE_LOOP
        for (k = 0; k < parts; ++k)
            of_y[k] = next[k];
        next += parts;
        for (j = 1; j < fewest_y + i; ++j, next += parts) {
            PENDULAR_TABLE_LOOP
            for (k = 0; k < parts; ++k)
                of_y[k] = of_y[k] * y + next[k];
        }
        PENDULAR_TABLE_LOOP
        for (k = 0; k < parts; ++k)
            of_x[k] = of_x[k] * x + of_y[k];
    }
    PENDULAR_TABLE_LOOP
    for (k = 0; k < parts; ++k)
        ((pendular_table_vector *)lanes)[k] = of_x[k];
}

/* The polynomial whose coefficients are the lanes, by halves. */
PENDULAR_FUNCTION double pendular_table_sum(const double *lanes, double t)
{
    const double t2 = t * t, t4 = t2 * t2;
    const double a = lanes[0] + t4 * lanes[4], b = lanes[1] + t4 * lanes[5];
    const double c = lanes[2] + t4 * lanes[6], d = lanes[3] + t4 * lanes[7];
    return (a + t2 * c) + t * (b + t2 * d);
}

/* Its rate in t, by halves. */
PENDULAR_FUNCTION double pendular_table_rate(const double *lanes, double t)
{
    const double t2 = t * t, t4 = t2 * t2;
    const double a = lanes[1] + t4 * (5.0 * lanes[5]), b = 2.0 * lanes[2] + t4 * (6.0 * lanes[6]);
    const double c = 3.0 * lanes[3] + t4 * (7.0 * lanes[7]), d = 4.0 * lanes[4];
    return (a + t2 * c) + t * (b + t2 * d);
}

/* -- A pair ---------------------------------------------------------------------------------------------------------- */

/* What the polynomial of a channel is multiplied by, but for units of its coefficients. */
PENDULAR_FUNCTION double pendular_table_scale(
    const pendular_table_channel *channel, double control, double radius, double surface_tension)
{
    double above = channel->factor, below = 1.0;
    int32_t i;
    if (channel->tension)
        above *= surface_tension;
    for (i = 0; i < channel->radius; ++i)
        above *= radius;
    for (i = 1; i < channel->control; i += 2)
        above *= control;
    if (channel->control > 0 && channel->control % 2 != 0)
        above *= sqrt(control);
    if (channel->radius >= 0 && channel->control >= 0)
        return above;
    for (i = 0; i > channel->radius; --i)
        below *= radius;
    for (i = -1; i > channel->control; i -= 2)
        below *= control;
    if (channel->control < 0 && channel->control % 2 != 0)
        below *= sqrt(control);
    return above / below;
}

PENDULAR_FUNCTION double pendular_table_unit_of(const pendular_table *table, int32_t row, int channel)
{
    return table->units ? table->units[(int64_t)row * table->channels + channel] : 1.0;
}

/* The polynomial of a quantity of the pair, of which the cell is known. */
PENDULAR_FUNCTION double pendular_table_star(const pendular_table *table, int channel, const pendular_table_place *place)
{
    double lanes[PENDULAR_TABLE_LANES];
    pendular_table_lanes(table->channel[channel].coefficients + (int64_t)place->size_cell * PENDULAR_TABLE_PAIR_CELL, 1,
        PENDULAR_TABLE_PAIR_TERMS, 0.0, place->y, lanes);
    return pendular_table_unit_of(table, place->row, channel) * pendular_table_sum(lanes, place->x);
}

/* A quantity of the pair. */
PENDULAR_FUNCTION double pendular_table_of_pair(
    const pendular_table *table, int channel, const pendular_table_place *place, double surface_tension)
{
    return pendular_table_scale(&table->channel[channel], place->control, place->radius, surface_tension)
        * pendular_table_star(table, channel, place);
}

/* Cube root of a positive number, to 14 digits: the same bits everywhere, which a library does not promise. */
PENDULAR_FUNCTION double pendular_table_cube_root(double number)
{
    const int64_t third = ((pendular_table_bits(number) >> 32) * INT64_C(0x55555556)) >> 32;
    double root = pendular_table_number(third * (INT64_C(1) << 32) + INT64_C(0x2A9F789300000000));
    int i;
    for (i = 0; i < 2; ++i) {
        const double cube = root * root * root;
        root = root * ((cube + 2.0 * number) / (2.0 * cube + number));
    }
    return root;
}

/* The size variable of s = (R1 - R2)/(R1 + R2). */
PENDULAR_FUNCTION double pendular_table_size_of(const pendular_table *table, double s)
{
    if (table->sides == 2)
        return s;
    return table->is_volume ? pendular_table_cube_root(s * s + 1e-60) : s * s;
}

/* About a third of the logarithm of a control over the middle of its cell. */
PENDULAR_FUNCTION double pendular_table_logarithmic(double control, double middle)
{
    return (control - middle) * (control + middle) / (control * (control + 4.0 * middle) + middle * middle);
}

PENDULAR_FUNCTION pendular_table_place pendular_table_find(
    const pendular_table *table, double control, double radius1, double radius2, double surface_tension)
{
    pendular_table_place place;
    const double small = radius1 < radius2 ? radius1 : radius2, large = radius1 < radius2 ? radius2 : radius1;
    const double ratio = small / large, share = 1.0 / (1.0 + ratio), radius = 2.0 * small * share;
    const double reduced = table->is_volume ? control / (radius * radius * radius) : control / surface_tension * radius;
    const int is_covered = reduced >= table->low && reduced <= table->high && ratio >= table->least_ratio
        && ratio <= table->largest_ratio && small > 0.0 && surface_tension > 0.0;
    const double *line;
    const int32_t *cut;
    double w, star;
    place.control = is_covered ? reduced : NAN;
    place.radius = is_covered ? radius : NAN;
    place.row = pendular_table_cell(place.control, table->shift, table->first, table->rows)
        + (table->sides == 2 && radius1 > radius2 ? table->rows : 0);
    line = table->lines + (int64_t)place.row * PENDULAR_TABLE_LINE;
    cut = table->cuts + (int64_t)place.row * PENDULAR_TABLE_CUT;
    w = line[PENDULAR_TABLE_U0] + line[PENDULAR_TABLE_U1] * pendular_table_size_of(table, (1.0 - ratio) * share);
    place.size_cell = cut[PENDULAR_TABLE_SIZE_CELLS]
        + pendular_table_cell(w, cut[PENDULAR_TABLE_U_SHIFT], cut[PENDULAR_TABLE_U_FIRST], cut[PENDULAR_TABLE_U_COUNT]);
    place.y = pendular_table_within(w, cut[PENDULAR_TABLE_U_SHIFT]);
    place.x = line[PENDULAR_TABLE_X1] * pendular_table_logarithmic(place.control, line[PENDULAR_TABLE_X0]);
    star = pendular_table_star(table, PENDULAR_TABLE_RUPTURE_DISTANCE, &place);
    place.rupture = place.radius * star;
    place.bend = table->is_volume ? star / (PENDULAR_TABLE_STRETCH * sqrt(place.control)) : 0.0;
    return place;
}

/* -- A bridge -------------------------------------------------------------------------------------------------------- */

/* The separation, 0 in an overlap. */
PENDULAR_FUNCTION double pendular_table_gap(double separation)
{
    return separation < 0.0 ? 0.0 : separation;
}

/* The root of (1 - D/Dc)/(1 + D/d): 0 at rupture, 1 at contact and in an overlap. */
PENDULAR_FUNCTION double pendular_table_q(const pendular_table_place *place, double separation)
{
    const double share = pendular_table_gap(separation) / place->rupture;
    return sqrt((1.0 - share) / (1.0 + place->bend * share));
}

/* The lanes of a channel in one of the cells of q of a pair. */
PENDULAR_FUNCTION void pendular_table_lanes_of(
    const pendular_table *table, int channel, const pendular_table_place *place, int32_t q_cell, double *lanes)
{
    const int32_t *cut = table->cuts + (int64_t)place->row * PENDULAR_TABLE_CUT;
    const int64_t cell = cut[PENDULAR_TABLE_CELLS] + q_cell
        + (int64_t)(place->size_cell - cut[PENDULAR_TABLE_SIZE_CELLS]) * cut[PENDULAR_TABLE_Q_COUNT];
    pendular_table_lanes(table->channel[channel].coefficients + cell * PENDULAR_TABLE_BRIDGE_CELL,
        PENDULAR_TABLE_CONTROL_TERMS, PENDULAR_TABLE_FEWEST_SIZE_TERMS, place->x, place->y, lanes);
}

PENDULAR_FUNCTION int32_t pendular_table_q_cell(const pendular_table *table, int32_t row, double q, double *w)
{
    const double *line = table->lines + (int64_t)row * PENDULAR_TABLE_LINE;
    const int32_t *cut = table->cuts + (int64_t)row * PENDULAR_TABLE_CUT;
    *w = line[PENDULAR_TABLE_Q0] + line[PENDULAR_TABLE_Q1] * q;
    return pendular_table_cell(
        *w, cut[PENDULAR_TABLE_Q_SHIFT], cut[PENDULAR_TABLE_Q_FIRST], cut[PENDULAR_TABLE_Q_COUNT]);
}

/* A quantity of a bridge that is there. */
PENDULAR_FUNCTION double pendular_table_of_bridge(const pendular_table *table, int channel,
    const pendular_table_place *place, double separation, double surface_tension)
{
    const int32_t shift = table->cuts[(int64_t)place->row * PENDULAR_TABLE_CUT + PENDULAR_TABLE_Q_SHIFT];
    double w, lanes[PENDULAR_TABLE_LANES];
    const int32_t q_cell = pendular_table_q_cell(table, place->row, pendular_table_q(place, separation), &w);
    pendular_table_lanes_of(table, channel, place, q_cell, lanes);
    return pendular_table_scale(&table->channel[channel], place->control, place->radius, surface_tension)
        * (pendular_table_unit_of(table, place->row, channel)
            * pendular_table_sum(lanes, pendular_table_within(w, shift)));
}

/* 0 from rupture on, NaN where the rupture distance or the separation is. */
PENDULAR_FUNCTION double pendular_table_beyond(const pendular_table_place *place, double separation)
{
    return pendular_table_gap(separation) >= place->rupture ? 0.0 : NAN;
}

PENDULAR_FUNCTION int pendular_table_is_bridge(const pendular_table_place *place, double separation)
{
    return pendular_table_gap(separation) < place->rupture;
}

PENDULAR_FUNCTION double pendular_table_force_at(
    const pendular_table *table, const pendular_table_place *place, double separation, double surface_tension)
{
    if (!pendular_table_is_bridge(place, separation))
        return pendular_table_beyond(place, separation);
    return pendular_table_of_bridge(table, PENDULAR_TABLE_FORCE, place, separation, surface_tension);
}

/* dF/dD, with dq/dD = -(1 + Dc/d)/(2 q Dc (1 + D/d)^2). */
PENDULAR_FUNCTION double pendular_table_stiffness_at(
    const pendular_table *table, const pendular_table_place *place, double separation, double surface_tension)
{
    const double *line = table->lines + (int64_t)place->row * PENDULAR_TABLE_LINE;
    const int32_t *cut = table->cuts + (int64_t)place->row * PENDULAR_TABLE_CUT;
    const int32_t shift = cut[PENDULAR_TABLE_Q_SHIFT], first = cut[PENDULAR_TABLE_Q_FIRST];
    double q, w, stretched, q_rate, t_rate, lanes[PENDULAR_TABLE_LANES];
    int32_t q_cell;
    if (!pendular_table_is_bridge(place, separation))
        return NAN;
    if (separation < 0.0)
        return 0.0;
    q = pendular_table_q(place, separation);
    q_cell = pendular_table_q_cell(table, place->row, q, &w);
    stretched = 1.0 + place->bend * (separation / place->rupture);
    q_rate = -0.5 * (1.0 + place->bend) / (q * place->rupture * stretched * stretched);
    t_rate = 2.0 / (pendular_table_edge(q_cell + 1, shift, first) - pendular_table_edge(q_cell, shift, first))
        * line[PENDULAR_TABLE_Q1] * q_rate;
    pendular_table_lanes_of(table, PENDULAR_TABLE_FORCE, place, q_cell, lanes);
    return pendular_table_scale(&table->channel[PENDULAR_TABLE_FORCE], place->control, place->radius, surface_tension)
        * (pendular_table_unit_of(table, place->row, PENDULAR_TABLE_FORCE)
            * pendular_table_rate(lanes, pendular_table_within(w, shift)) * t_rate);
}

/* The integral of q (1 + b)/(1 + b q^2)^2 times the polynomial of the force, from rupture to an end, cell by cell, with
   b = Dc/d: eight points are exact, or nearly so where b is not 0. */
PENDULAR_FUNCTION double pendular_table_integral(
    const pendular_table *table, const pendular_table_place *place, double end)
{
    const double abscissae[8] = { -0.9602898564975362, -0.7966664774136267, -0.525532409916329, -0.18343464249564978,
        0.18343464249564978, 0.525532409916329, 0.7966664774136267, 0.9602898564975362 };
    const double weights[8] = { 0.10122853629037706, 0.22238103445337443, 0.3137066458778869, 0.36268378337836166,
        0.36268378337836166, 0.3137066458778869, 0.22238103445337443, 0.10122853629037706 };
    const double *line = table->lines + (int64_t)place->row * PENDULAR_TABLE_LINE;
    const int32_t *cut = table->cuts + (int64_t)place->row * PENDULAR_TABLE_CUT;
    const int32_t shift = cut[PENDULAR_TABLE_Q_SHIFT], step = line[PENDULAR_TABLE_Q1] > 0.0 ? 1 : -1;
    const double unit = pendular_table_unit_of(table, place->row, PENDULAR_TABLE_FORCE);
    double w, q, far, high, half, bent, weight, total = 0.0, low = 0.0, lanes[PENDULAR_TABLE_LANES];
    const int32_t last = pendular_table_q_cell(table, place->row, end, &w);
    int32_t cell = pendular_table_q_cell(table, place->row, 0.0, &w);
    int j;
    for (;; cell += step) {
        far = pendular_table_edge(step > 0 ? cell + 1 : cell, shift, cut[PENDULAR_TABLE_Q_FIRST]);
        high = cell == last ? end : (far - line[PENDULAR_TABLE_Q0]) / line[PENDULAR_TABLE_Q1];
        half = 0.5 * (high - low);
        pendular_table_lanes_of(table, PENDULAR_TABLE_FORCE, place, cell, lanes);
        for (j = 0; j < 8; ++j) {
            q = 0.5 * (low + high) + half * abscissae[j];
            w = line[PENDULAR_TABLE_Q0] + line[PENDULAR_TABLE_Q1] * q;
            bent = 1.0 + place->bend * q * q;
            weight = half * weights[j] * q * (1.0 + place->bend) / (bent * bent);
            total += weight * (unit * pendular_table_sum(lanes, pendular_table_within(w, shift)));
        }
        if (cell == last)
            return total;
        low = high;
    }
}

/* E(D) = -(the integral of F from D to Dc), with dD/dq = -2 Dc q (1 + b)/(1 + b q^2)^2. */
PENDULAR_FUNCTION double pendular_table_energy_at(
    const pendular_table *table, const pendular_table_place *place, double separation, double surface_tension)
{
    double unit, work, overlap;
    if (!pendular_table_is_bridge(place, separation))
        return pendular_table_beyond(place, separation);
    unit = pendular_table_scale(&table->channel[PENDULAR_TABLE_FORCE], place->control, place->radius, surface_tension);
    work = 2.0 * place->rupture * unit
        * pendular_table_integral(table, place, pendular_table_q(place, separation));
    overlap = separation < 0.0 ? -separation : 0.0;
    return -work - overlap * pendular_table_force_at(table, place, 0.0, surface_tension);
}

/* -- Answers --------------------------------------------------------------------------------------------------------- */

/* Separation at which the bridge breaks [m]: the end of its stability; 0 where there is no bridge. */
PENDULAR_FUNCTION double pendular_table_rupture_distance(
    const pendular_table *table, double control, double radius1, double radius2, double surface_tension)
{
    return pendular_table_find(table, control, radius1, radius2, surface_tension).rupture;
}

/* Attraction of two solids [N]: 0 from the rupture distance on. */
PENDULAR_FUNCTION double pendular_table_force(const pendular_table *table, double separation, double control,
    double radius1, double radius2, double surface_tension)
{
    const pendular_table_place place = pendular_table_find(table, control, radius1, radius2, surface_tension);
    return pendular_table_force_at(table, &place, separation, surface_tension);
}

/* Rate dF/dD with the control held [N/m]: 0 in an overlap, NaN where there is no bridge. */
PENDULAR_FUNCTION double pendular_table_stiffness(const pendular_table *table, double separation, double control,
    double radius1, double radius2, double surface_tension)
{
    const pendular_table_place place = pendular_table_find(table, control, radius1, radius2, surface_tension);
    return pendular_table_stiffness_at(table, &place, separation, surface_tension);
}

/* Potential with F = dE/dD [J]: minus the work that breaks the bridge, 0 from the rupture distance on. */
PENDULAR_FUNCTION double pendular_table_energy(const pendular_table *table, double separation, double control,
    double radius1, double radius2, double surface_tension)
{
    const pendular_table_place place = pendular_table_find(table, control, radius1, radius2, surface_tension);
    return pendular_table_energy_at(table, &place, separation, surface_tension);
}

/* Any answer, by its number above or that of a channel; NaN for a number that is none. */
PENDULAR_FUNCTION double pendular_table_value(const pendular_table *table, int asked, double separation, double control,
    double radius1, double radius2, double surface_tension)
{
    const pendular_table_place place = pendular_table_find(table, control, radius1, radius2, surface_tension);
    if (asked == PENDULAR_TABLE_RUPTURE_DISTANCE)
        return place.rupture;
    if (asked == PENDULAR_TABLE_FORCE)
        return pendular_table_force_at(table, &place, separation, surface_tension);
    if (asked == PENDULAR_TABLE_STIFFNESS)
        return pendular_table_stiffness_at(table, &place, separation, surface_tension);
    if (asked == PENDULAR_TABLE_ENERGY)
        return pendular_table_energy_at(table, &place, separation, surface_tension);
    if (asked < 0 || asked >= table->channels)
        return NAN;
    if (!table->channel[asked].is_of_bridge)
        return pendular_table_of_pair(table, asked, &place, surface_tension);
    if (!pendular_table_is_bridge(&place, separation))
        return NAN;
    return pendular_table_of_bridge(table, asked, &place, separation, surface_tension);
}

/* Liquid volume under suction [m3], suction at constant volume [Pa]; NaN where there is no bridge. */
PENDULAR_FUNCTION double pendular_table_liquid(const pendular_table *table, double separation, double control,
    double radius1, double radius2, double surface_tension)
{
    const pendular_table_place place = pendular_table_find(table, control, radius1, radius2, surface_tension);
    if (!pendular_table_is_bridge(&place, separation))
        return NAN;
    return pendular_table_of_bridge(table, PENDULAR_TABLE_LIQUID, &place, separation, surface_tension);
}

/* One answer for each contact of a block. */
PENDULAR_FUNCTION void pendular_table_block(const pendular_table *table, int asked, size_t count,
    const double *separation, const double *control, const double *radius1, const double *radius2,
    double surface_tension, double *out)
{
    size_t i;
    for (i = 0; i < count; ++i)
        out[i] = pendular_table_value(
            table, asked, separation[i], control[i], radius1[i], radius2[i], surface_tension);
}

/* -- The file -------------------------------------------------------------------------------------------------------- */

/* Why a table was not opened. */
enum {
    PENDULAR_TABLE_OK,
    PENDULAR_TABLE_UNREADABLE,
    PENDULAR_TABLE_NO_MEMORY,
    PENDULAR_TABLE_NOT_ALIGNED,
    PENDULAR_TABLE_NO_TABLE,
    PENDULAR_TABLE_BYTE_ORDER,
    PENDULAR_TABLE_UNKNOWN_VERSION,
    PENDULAR_TABLE_WRONG_SIZE,
    PENDULAR_TABLE_DAMAGED,
    PENDULAR_TABLE_WRONG_HEADER,
    PENDULAR_TABLE_WRONG_CHANNEL,
    PENDULAR_TABLE_WRONG_CUTS,
    PENDULAR_TABLE_NOT_FINITE
};

PENDULAR_HOST const char *pendular_table_error(int code)
{
    switch (code) {
    case PENDULAR_TABLE_OK:
        return "no error";
    case PENDULAR_TABLE_UNREADABLE:
        return "the file cannot be read";
    case PENDULAR_TABLE_NO_MEMORY:
        return "there is no memory for the file";
    case PENDULAR_TABLE_NOT_ALIGNED:
        return "the memory does not begin at a multiple of eight bytes";
    case PENDULAR_TABLE_NO_TABLE:
        return "it is not a table of bridges";
    case PENDULAR_TABLE_BYTE_ORDER:
        return "its order of bytes is not that of this machine";
    case PENDULAR_TABLE_UNKNOWN_VERSION:
        return "its version of the format is not known";
    case PENDULAR_TABLE_WRONG_SIZE:
        return "it is shorter or longer than it says";
    case PENDULAR_TABLE_DAMAGED:
        return "it is damaged: its checksum does not agree";
    case PENDULAR_TABLE_WRONG_HEADER:
        return "a number of its header is out of range";
    case PENDULAR_TABLE_WRONG_CHANNEL:
        return "a channel is not described as it has to be";
    case PENDULAR_TABLE_WRONG_CUTS:
        return "its cells do not cover its range one after another";
    case PENDULAR_TABLE_NOT_FINITE:
        return "a number of it is not finite";
    default:
        return "no code of an error";
    }
}

PENDULAR_HOST uint32_t pendular_table_u32(const unsigned char *bytes)
{
    uint32_t number;
    memcpy(&number, bytes, sizeof number);
    return number;
}

PENDULAR_HOST uint64_t pendular_table_u64(const unsigned char *bytes)
{
    uint64_t number;
    memcpy(&number, bytes, sizeof number);
    return number;
}

PENDULAR_HOST double pendular_table_f64(const unsigned char *bytes)
{
    double number;
    memcpy(&number, bytes, sizeof number);
    return number;
}

/* CRC-32 as of zlib and IEEE 802.3. */
PENDULAR_HOST uint32_t pendular_table_crc32(const unsigned char *bytes, size_t size)
{
    uint32_t rest[256], crc = 0xffffffffu;
    size_t i;
    uint32_t byte;
    int bit;
    for (byte = 0; byte < 256; ++byte) {
        rest[byte] = byte;
        for (bit = 0; bit < 8; ++bit)
            rest[byte] = rest[byte] & 1u ? (rest[byte] >> 1) ^ 0xedb88320u : rest[byte] >> 1;
    }
    for (i = 0; i < size; ++i)
        crc = rest[(crc ^ bytes[i]) & 0xffu] ^ (crc >> 8);
    return crc ^ 0xffffffffu;
}

PENDULAR_HOST int pendular_table_are_finite(const double *numbers, uint64_t count)
{
    uint64_t i;
    for (i = 0; i < count; ++i)
        if (!(numbers[i] - numbers[i] == 0.0))
            return 0;
    return 1;
}

/* Printable characters of ASCII, at least one, and zeros up to the end. */
PENDULAR_HOST int pendular_table_is_text(const unsigned char *bytes, size_t room)
{
    size_t i, length = 0;
    while (length < room && bytes[length] >= 32 && bytes[length] < 127)
        ++length;
    for (i = length; i < room; ++i)
        if (bytes[i])
            return 0;
    return length > 0 && length < room;
}

/* Whether a number lies in one of the cells. */
PENDULAR_HOST int pendular_table_is_in(double w, int32_t shift, int32_t first, int32_t count)
{
    const int64_t cell = w > 0.0 ? (pendular_table_bits(w) >> shift) - first : -1;
    return cell >= 0 && cell < count;
}

/* Whether bits from first on, shifted, are the ends of so many cells, all of them finite and positive numbers. */
PENDULAR_HOST int pendular_table_is_cut(int32_t shift, int32_t first, int32_t count)
{
    return shift >= 33 && shift <= 52 && first >= 0 && count >= 1
        && (int64_t)first + count < (int64_t)2047 << (52 - shift);
}

/* Each row shares the cells of the one before, or begins where that ends, and covers the sizes and q from 0 to 1. */
PENDULAR_HOST int pendular_table_check_rows(const pendular_table *table, uint32_t size_cells, uint32_t cells)
{
    const double low_s = (1.0 - table->largest_ratio) / (1.0 + table->largest_ratio);
    const double high_s = (1.0 - table->least_ratio) / (1.0 + table->least_ratio);
    const double low_u = pendular_table_size_of(table, low_s), high_u = pendular_table_size_of(table, high_s);
    int64_t next_size_cell = 0, next_cell = 0, row;
    if (!pendular_table_is_cut(table->shift, table->first, table->rows)
        || !pendular_table_is_in(table->low, table->shift, table->first, table->rows)
        || !pendular_table_is_in(table->high, table->shift, table->first, table->rows))
        return PENDULAR_TABLE_WRONG_CUTS;
    for (row = 0; row < (int64_t)table->sides * table->rows; ++row) {
        const double *line = table->lines + row * PENDULAR_TABLE_LINE;
        const int32_t *cut = table->cuts + row * PENDULAR_TABLE_CUT;
        const double u0 = line[PENDULAR_TABLE_U0], u1 = line[PENDULAR_TABLE_U1];
        const double q0 = line[PENDULAR_TABLE_Q0], q1 = line[PENDULAR_TABLE_Q1];
        const int32_t *u_cut = cut + PENDULAR_TABLE_U_SHIFT, *q_cut = cut + PENDULAR_TABLE_Q_SHIFT;
        if (!pendular_table_are_finite(line, PENDULAR_TABLE_LINE))
            return PENDULAR_TABLE_NOT_FINITE;
        if (!pendular_table_is_cut(u_cut[0], u_cut[1], u_cut[2]) || !pendular_table_is_cut(q_cut[0], q_cut[1], q_cut[2])
            || !pendular_table_is_in(u0 + u1 * low_u, u_cut[0], u_cut[1], u_cut[2])
            || !pendular_table_is_in(u0 + u1 * high_u, u_cut[0], u_cut[1], u_cut[2])
            || !pendular_table_is_in(q0, q_cut[0], q_cut[1], q_cut[2])
            || !pendular_table_is_in(q0 + q1, q_cut[0], q_cut[1], q_cut[2]) || q1 == 0.0
            || line[PENDULAR_TABLE_X0] <= 0.0 || line[PENDULAR_TABLE_X1] < 0.0)
            return PENDULAR_TABLE_WRONG_CUTS;
        if (cut[PENDULAR_TABLE_SIZE_CELLS] == next_size_cell && cut[PENDULAR_TABLE_CELLS] == next_cell) {
            next_size_cell += u_cut[2];
            next_cell += (int64_t)u_cut[2] * q_cut[2];
        } else if (row == 0 || memcmp(cut, cut - PENDULAR_TABLE_CUT, PENDULAR_TABLE_CUT * sizeof *cut) != 0)
            return PENDULAR_TABLE_WRONG_CUTS;
        if (next_size_cell > size_cells || next_cell > cells)
            return PENDULAR_TABLE_WRONG_CUTS;
    }
    return next_size_cell == size_cells && next_cell == cells ? PENDULAR_TABLE_OK : PENDULAR_TABLE_WRONG_CUTS;
}

/* Name, unit, and what the bound is relative to, of a channel of an open file; NULL where there is none. */
PENDULAR_HOST const char *pendular_table_text(const pendular_table *table, int channel, size_t place)
{
    if (!table->bytes || channel < 0 || channel >= table->channels)
        return NULL;
    return (const char *)table->bytes + PENDULAR_TABLE_HEADER + (size_t)channel * PENDULAR_TABLE_CHANNEL + place;
}

PENDULAR_HOST const char *pendular_table_name(const pendular_table *table, int channel)
{
    return pendular_table_text(table, channel, 0);
}

PENDULAR_HOST const char *pendular_table_unit(const pendular_table *table, int channel)
{
    return pendular_table_text(table, channel, 24);
}

PENDULAR_HOST const char *pendular_table_bound_of(const pendular_table *table, int channel)
{
    return pendular_table_text(table, channel, 40);
}

/* Number of the channel of a name, -1 if there is none. */
PENDULAR_HOST int pendular_table_find_channel(const pendular_table *table, const char *name)
{
    int i;
    for (i = 0; table->bytes && i < table->channels; ++i)
        if (strcmp(pendular_table_name(table, i), name) == 0)
            return i;
    return -1;
}

PENDULAR_HOST int pendular_table_read_channel(pendular_table *table, int number)
{
    const unsigned char *bytes = table->bytes + PENDULAR_TABLE_HEADER + (size_t)number * PENDULAR_TABLE_CHANNEL;
    const char *first[3] = { "rupture_distance", "force", table->is_volume ? "suction" : "volume" };
    pendular_table_channel *channel = &table->channel[number];
    if (!pendular_table_is_text(bytes, 24) || !pendular_table_is_text(bytes + 24, 16)
        || !pendular_table_is_text(bytes + 40, 40) || pendular_table_find_channel(table, (const char *)bytes) != number)
        return PENDULAR_TABLE_WRONG_CHANNEL;
    channel->factor = pendular_table_f64(bytes + 80);
    channel->bound = pendular_table_f64(bytes + 88);
    memcpy(&channel->is_of_bridge, bytes + 96, sizeof(int32_t));
    memcpy(&channel->tension, bytes + 100, sizeof(int32_t));
    memcpy(&channel->radius, bytes + 104, sizeof(int32_t));
    memcpy(&channel->control, bytes + 108, sizeof(int32_t));
    if (!(channel->factor - channel->factor == 0.0) || !(channel->bound >= 0.0)
        || (channel->is_of_bridge != 0 && channel->is_of_bridge != 1)
        || (channel->tension != 0 && channel->tension != 1) || channel->radius < -8 || channel->radius > 8
        || channel->control < -16 || channel->control > 16)
        return PENDULAR_TABLE_WRONG_CHANNEL;
    if (number < 3
        && (strcmp((const char *)bytes, first[number]) != 0
            || channel->is_of_bridge != (number != PENDULAR_TABLE_RUPTURE_DISTANCE)))
        return PENDULAR_TABLE_WRONG_CHANNEL;
    return PENDULAR_TABLE_OK;
}

PENDULAR_HOST int pendular_table_read_header(pendular_table *table)
{
    const unsigned char *bytes = table->bytes;
    const uint32_t control = pendular_table_u32(bytes + 24), sides = pendular_table_u32(bytes + 28);
    const uint32_t rows = pendular_table_u32(bytes + 32), channels = pendular_table_u32(bytes + 36);
    memcpy(&table->shift, bytes + 40, sizeof(int32_t));
    memcpy(&table->first, bytes + 44, sizeof(int32_t));
    memcpy(table->contact_angle, bytes + 56, 2 * sizeof(double));
    memcpy(table->reduced, bytes + 72, 2 * sizeof(double));
    memcpy(table->radius_ratio, bytes + 88, 2 * sizeof(double));
    table->low = pendular_table_f64(bytes + 104);
    table->high = pendular_table_f64(bytes + 112);
    table->least_ratio = pendular_table_f64(bytes + 120);
    table->largest_ratio = pendular_table_f64(bytes + 128);
    table->tolerance = pendular_table_f64(bytes + 136);
    if (control > 1 || sides < 1 || sides > 2 || rows < 1 || rows > 1 << 24 || channels < 3
        || channels > PENDULAR_TABLE_MOST_CHANNELS || pendular_table_u32(bytes + 48) > 0x7fffffff
        || pendular_table_u32(bytes + 52) > 0x7fffffff || !pendular_table_is_text(bytes + 152, 24))
        return PENDULAR_TABLE_WRONG_HEADER;
    table->is_volume = (int32_t)control;
    table->sides = (int32_t)sides;
    table->rows = (int32_t)rows;
    table->channels = (int32_t)channels;
    if (!(table->contact_angle[0] >= 0.0 && table->contact_angle[0] < 3.1415926535898)
        || !(table->contact_angle[1] >= 0.0 && table->contact_angle[1] < 3.1415926535898)
        || (table->contact_angle[0] == table->contact_angle[1]) != (sides == 1)
        || !(table->reduced[0] > 0.0 && table->reduced[0] <= table->reduced[1] && table->reduced[1] < INFINITY)
        || !(table->radius_ratio[0] >= 1.0 && table->radius_ratio[0] <= table->radius_ratio[1])
        || !(table->low > 0.0 && table->low <= table->high && table->high < INFINITY)
        || !(table->least_ratio >= 0.0 && table->least_ratio <= table->largest_ratio && table->largest_ratio < 1.001)
        || !(table->tolerance > 0.0 && table->tolerance < 1.0))
        return PENDULAR_TABLE_WRONG_HEADER;
    return PENDULAR_TABLE_OK;
}

/* Where the parts begin; whether the file is as long as they are. */
PENDULAR_HOST int pendular_table_lay_out(pendular_table *table, size_t size)
{
    const uint64_t rows = (uint64_t)table->sides * (uint64_t)table->rows;
    const uint64_t size_cells = pendular_table_u32(table->bytes + 48), cells = pendular_table_u32(table->bytes + 52);
    const uint64_t lines = PENDULAR_TABLE_HEADER + (uint64_t)table->channels * PENDULAR_TABLE_CHANNEL;
    const uint64_t cuts = lines + rows * PENDULAR_TABLE_LINE * sizeof(double);
    uint64_t start = cuts + rows * PENDULAR_TABLE_CUT * sizeof(int32_t);
    uint64_t starts[PENDULAR_TABLE_MOST_CHANNELS];
    int i;
    start = (start + PENDULAR_TABLE_ALIGNMENT - 1) / PENDULAR_TABLE_ALIGNMENT * PENDULAR_TABLE_ALIGNMENT;
    for (i = 0; i < table->channels; ++i) {
        starts[i] = start;
        start += sizeof(double)
            * (table->channel[i].is_of_bridge ? cells * PENDULAR_TABLE_BRIDGE_CELL
                                              : size_cells * PENDULAR_TABLE_PAIR_CELL);
    }
    if (start + PENDULAR_TABLE_CHECKSUM != size)
        return PENDULAR_TABLE_WRONG_SIZE;
    table->lines = (const double *)(const void *)(table->bytes + lines);
    table->cuts = (const int32_t *)(const void *)(table->bytes + cuts);
    for (i = 0; i < table->channels; ++i)
        table->channel[i].coefficients = (const double *)(const void *)(table->bytes + starts[i]);
    if (!pendular_table_are_finite(table->channel[0].coefficients, (size - PENDULAR_TABLE_CHECKSUM - starts[0]) / 8))
        return PENDULAR_TABLE_NOT_FINITE;
    return pendular_table_check_rows(table, (uint32_t)size_cells, (uint32_t)cells);
}

PENDULAR_HOST int pendular_table_read(const unsigned char *bytes, size_t size, pendular_table *table)
{
    const unsigned char magic[8] = { 0x89, 'B', 'R', 'I', 'D', 'G', 'E', '\n' };
    int i, code;
    memset(table, 0, sizeof *table);
    table->bytes = bytes;
    if ((uintptr_t)bytes % sizeof(double) != 0)
        return PENDULAR_TABLE_NOT_ALIGNED;
    if (size < sizeof magic || memcmp(bytes, magic, sizeof magic) != 0)
        return PENDULAR_TABLE_NO_TABLE;
    if (size < PENDULAR_TABLE_HEADER + PENDULAR_TABLE_CHECKSUM)
        return PENDULAR_TABLE_WRONG_SIZE;
    if (pendular_table_u32(bytes + 8) != 0x01020304u)
        return PENDULAR_TABLE_BYTE_ORDER;
    if (pendular_table_u32(bytes + 12) != PENDULAR_TABLE_VERSION)
        return PENDULAR_TABLE_UNKNOWN_VERSION;
    if (pendular_table_u64(bytes + 16) != size)
        return PENDULAR_TABLE_WRONG_SIZE;
    size -= PENDULAR_TABLE_CHECKSUM;
    if (pendular_table_crc32(bytes, size) != pendular_table_u32(bytes + size))
        return PENDULAR_TABLE_DAMAGED;
    size += PENDULAR_TABLE_CHECKSUM;
    code = pendular_table_read_header(table);
    if (code == PENDULAR_TABLE_OK && size < PENDULAR_TABLE_HEADER + (size_t)table->channels * PENDULAR_TABLE_CHANNEL)
        code = PENDULAR_TABLE_WRONG_SIZE;
    for (i = 0; code == PENDULAR_TABLE_OK && i < table->channels; ++i)
        code = pendular_table_read_channel(table, i);
    return code == PENDULAR_TABLE_OK ? pendular_table_lay_out(table, size) : code;
}

/* Open a table that lies in memory, which begins at a multiple of eight bytes (best of 64) and stays as long as the table
   is used. Returns a code; where it is not PENDULAR_TABLE_OK, the table is empty. */
PENDULAR_HOST int pendular_table_view(const void *bytes, size_t size, pendular_table *table)
{
    const int code = pendular_table_read((const unsigned char *)bytes, size, table);
    if (code != PENDULAR_TABLE_OK)
        memset(table, 0, sizeof *table);
    return code;
}

/* The same table with its bytes copied elsewhere, as to the memory of a GPU, where a kernel takes it by value. */
PENDULAR_HOST pendular_table pendular_table_moved(const pendular_table *table, const void *bytes)
{
    pendular_table moved = *table;
    const unsigned char *to = (const unsigned char *)bytes;
    int i;
    moved.lines = (const double *)(const void *)(to + ((const unsigned char *)table->lines - table->bytes));
    moved.cuts = (const int32_t *)(const void *)(to + ((const unsigned char *)table->cuts - table->bytes));
    for (i = 0; i < table->channels; ++i)
        moved.channel[i].coefficients = (const double *)(const void *)(to
            + ((const unsigned char *)table->channel[i].coefficients - table->bytes));
    moved.bytes = to;
    moved.owned = NULL;
    return moved;
}

/* Bytes of the file of an open table. */
PENDULAR_HOST size_t pendular_table_size(const pendular_table *table)
{
    return table->bytes ? (size_t)pendular_table_u64(table->bytes + 16) : 0;
}

#ifndef PENDULAR_TABLE_NO_FILES

PENDULAR_HOST int pendular_table_read_file(FILE *file, pendular_table *table)
{
    long size;
    void *owned;
    unsigned char *bytes;
    int code;
    if (fseek(file, 0, SEEK_END) != 0)
        return PENDULAR_TABLE_UNREADABLE;
    size = ftell(file);
    if (size < 0 || (unsigned long)size > (size_t)-1 / 2 - PENDULAR_TABLE_ALIGNMENT || fseek(file, 0, SEEK_SET) != 0)
        return PENDULAR_TABLE_UNREADABLE;
    owned = malloc((size_t)size + PENDULAR_TABLE_ALIGNMENT);
    if (!owned)
        return PENDULAR_TABLE_NO_MEMORY;
    bytes = (unsigned char *)owned
        + (PENDULAR_TABLE_ALIGNMENT - (uintptr_t)owned % PENDULAR_TABLE_ALIGNMENT) % PENDULAR_TABLE_ALIGNMENT;
    code = fread(bytes, 1, (size_t)size, file) == (size_t)size ? pendular_table_view(bytes, (size_t)size, table)
                                                               : (int)PENDULAR_TABLE_UNREADABLE;
    if (code == PENDULAR_TABLE_OK)
        table->owned = owned;
    else
        free(owned);
    return code;
}

/* Open the table of a file. Returns a code; where it is not PENDULAR_TABLE_OK, the table is empty. */
PENDULAR_HOST int pendular_table_open(const char *path, pendular_table *table)
{
    FILE *file = fopen(path, "rb");
    int code;
    memset(table, 0, sizeof *table);
    if (!file)
        return PENDULAR_TABLE_UNREADABLE;
    code = pendular_table_read_file(file, table);
    fclose(file);
    return code;
}

/* Free what pendular_table_open took. */
PENDULAR_HOST void pendular_table_close(pendular_table *table)
{
    free(table->owned);
    memset(table, 0, sizeof *table);
}

#endif
#endif
