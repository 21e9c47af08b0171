/* Bridges of a packing in YADE: the loops over neighbours, from a table. Called by pendular_yade.py, see
   docs/yade_engine.md.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#include "pendular_table.h"

/* Why a step was not made; else 0. */
enum { OUT_OF_RANGE = 1 };

/* What a body is: a wall across one of three axes is told by the number of its axis. */
enum { SPHERE = -1, FACET = 3, BOX = 4 };

/* A facet or a box: its three corners, or half its edges, as the body has them, and the rotation of the body. */
typedef struct {
    double corners[9], rotation[9];
} pendular_yade_surface;

/* Neighbours and bodies, in arrays of Python. The first of a pair is a sphere. */
typedef struct {
    const pendular_table *grains, *walls;
    double surface_tension;
    size_t pairs, bodies, surfaces;
    const int32_t *first, *second;
    const double *beside;            /* in a periodic cell the second is moved by it; or NULL */
    unsigned char *has_bridge;
    double *volumes;                 /* of bridges, or NULL where all hold the same */
    const double *places, *radius;   /* places are rows of x, of y and of z */
    const signed char *kind;
    const int32_t *surface_of;       /* number of a facet or box */
    const pendular_yade_surface *surface;
    const int32_t *at_surfaces;      /* pairs with walls, facets and boxes, those of one sphere side by side */
    unsigned char *is_hidden;        /* pairs whose bridge is with another, nearer part of the wall */
    size_t out_of_range;             /* pair, for errors */
    int forms_apart;
} pendular_yade_heap;

size_t pendular_yade_size(void);
int pendular_yade_open(const char *path, pendular_table *table);
void pendular_yade_close(pendular_table *table);
const char *pendular_yade_error(int code);
void pendular_yade_about(const pendular_table *table, double *numbers);
double pendular_yade_value(const pendular_table *table, int asked, double separation, double control, double radius1,
    double radius2, double surface_tension);
void pendular_yade_gaps(const pendular_yade_heap *heap, double *separation);
void pendular_yade_settle(pendular_yade_heap *heap, double *film);
int pendular_yade_exchange(pendular_yade_heap *heap, double most, double share, double *film, double *offer);
int pendular_yade_step(
    pendular_yade_heap *heap, double control, double *forces, double *separation, double *attraction);

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

/* -- Shapes ---------------------------------------------------------------------------------------------------------- */

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double between(double low, double value, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* The point of an edge nearest to a point. */
static void on_edge(const double *from, const double *to, const double *point, double *nearest)
{
    double along[3], way[3], share;
    int k;
    for (k = 0; k < 3; ++k) {
        along[k] = to[k] - from[k];
        way[k] = point[k] - from[k];
    }
    share = between(0.0, dot(way, along) / dot(along, along), 1.0);
    for (k = 0; k < 3; ++k)
        nearest[k] = from[k] + share * along[k];
}

static double distance_squared(const double *a, const double *b)
{
    const double way[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    return dot(way, way);
}

/* The point of a triangle nearest to a point: under it, or on an edge. */
static void on_triangle(const double *corners, const double *point, double *nearest)
{
    double one[3], two[3], way[3], a, b, c, d, e, whole, s, t, edge[3];
    int k;
    for (k = 0; k < 3; ++k) {
        one[k] = corners[3 + k] - corners[k];
        two[k] = corners[6 + k] - corners[k];
        way[k] = point[k] - corners[k];
    }
    a = dot(one, one), b = dot(one, two), c = dot(two, two), d = dot(way, one), e = dot(way, two);
    whole = a * c - b * b;
    s = (c * d - b * e) / whole, t = (a * e - b * d) / whole;
    for (k = 0; k < 3; ++k)
        nearest[k] = corners[k] + s * one[k] + t * two[k];
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0)
        return;
    on_edge(corners, corners + 3, point, nearest);
    on_edge(corners + 3, corners + 6, point, edge);
    if (distance_squared(edge, point) < distance_squared(nearest, point))
        memcpy(nearest, edge, sizeof edge);
    on_edge(corners + 6, corners, point, edge);
    if (distance_squared(edge, point) < distance_squared(nearest, point))
        memcpy(nearest, edge, sizeof edge);
}

/* Distance from a point, in the frame of the body, to its surface, negative within a box, and the unit vector to the body. */
static double to_surface(int kind, const double *corners, const double *point, double *towards)
{
    double nearest[3], length;
    int k, flat = 0;
    if (kind == FACET)
        on_triangle(corners, point, nearest);
    else
        for (k = 0; k < 3; ++k)
            nearest[k] = between(-corners[k], point[k], corners[k]);
    length = sqrt(distance_squared(nearest, point));
    for (k = 0; k < 3; ++k)
        towards[k] = (nearest[k] - point[k]) / length;
    if (length > 0.0)
        return length;
    for (k = 1; kind == BOX && k < 3; ++k) /* within: the nearest face */
        flat = corners[k] - fabs(point[k]) < corners[flat] - fabs(point[flat]) ? k : flat;
    for (k = 0; k < 3; ++k)
        towards[k] = k != flat ? 0.0 : point[k] > 0.0 ? -1.0 : 1.0;
    return kind == BOX ? fabs(point[flat]) - corners[flat] : 0.0;
}

static double to_body(const pendular_yade_surface *surface, int kind, const double *way, double *towards)
{
    const double *turn = surface->rotation;
    double point[3], own[3], length;
    int k;
    for (k = 0; k < 3; ++k) /* from the body to the sphere, in the frame of the body */
        point[k] = -(turn[k] * way[0] + turn[3 + k] * way[1] + turn[6 + k] * way[2]);
    length = to_surface(kind, surface->corners, point, own);
    for (k = 0; k < 3; ++k)
        towards[k] = dot(turn + 3 * k, own);
    return length;
}

/* Separation of a pair, and the unit vector from the first to the second; a wall is a plane across its axis. */
static double apart(const pendular_yade_heap *heap, size_t n, double *towards)
{
    const int32_t i = heap->first[n], j = heap->second[n];
    const int kind = heap->kind[j];
    double length;
    int k;
    for (k = 0; k < 3; ++k) {
        const double way = heap->places[k * heap->bodies + j] - heap->places[k * heap->bodies + i];
        towards[k] = kind >= FACET || kind == SPHERE || kind == k ? way : 0.0;
        if (heap->beside)
            towards[k] += heap->beside[3 * n + k];
    }
    if (kind >= FACET) {
        const double way[3] = { towards[0], towards[1], towards[2] };
        return to_body(heap->surface + heap->surface_of[j], kind, way, towards) - heap->radius[i];
    }
    length = sqrt(dot(towards, towards));
    for (k = 0; k < 3; ++k)
        towards[k] /= length;
    return length - heap->radius[i] - (kind == SPHERE ? heap->radius[j] : 0.0);
}

static int is_wall(const pendular_yade_heap *heap, size_t n)
{
    return heap->kind[heap->second[n]] != SPHERE;
}

void pendular_yade_gaps(const pendular_yade_heap *heap, double *separation)
{
    double towards[3];
    size_t n;
    for (n = 0; n < heap->pairs; ++n)
        separation[n] = apart(heap, n, towards);
}

/* -- Walls of many parts --------------------------------------------------------------------------------------------- */

/* The bridge of a sphere, to the part of the wall that is nearer in nearly the same direction. */
static void move_bridge(pendular_yade_heap *heap, size_t from, size_t to, double *film)
{
    if (heap->has_bridge[from] && heap->volumes) {
        if (heap->has_bridge[to])
            film[heap->first[from]] += heap->volumes[from];
        else
            heap->volumes[to] = heap->volumes[from];
        heap->volumes[from] = 0.0;
    }
    heap->has_bridge[to] |= heap->has_bridge[from];
    heap->has_bridge[from] = 0;
    heap->is_hidden[from] = 1;
}

/* Of pairs with one sphere that lie within 45 degrees of this one, itself too, the nearest; of equals the first. */
static size_t nearest_beside(const pendular_yade_heap *heap, size_t n, const int32_t *with, size_t count)
{
    const double nearly = 0.70710678118654752;
    double towards[3], least = apart(heap, n, towards);
    size_t nearest = n, k;
    for (k = 0; k < count; ++k) {
        const size_t m = with[k];
        double other[3], its = apart(heap, m, other);
        if ((its < least || (its == least && m < nearest)) && dot(towards, other) > nearly) {
            least = its;
            nearest = m;
        }
    }
    return nearest;
}

/* Of the facets, boxes and walls near a sphere that lie within 45 degrees of each other the nearest has the bridge. */
void pendular_yade_settle(pendular_yade_heap *heap, double *film)
{
    size_t begin, end, k;
    memset(heap->is_hidden, 0, heap->pairs);
    for (begin = 0; begin < heap->surfaces; begin = end) {
        const int32_t *with = heap->at_surfaces + begin;
        for (end = begin; end < heap->surfaces && heap->first[heap->at_surfaces[end]] == heap->first[with[0]];)
            ++end;
        for (k = 0; k < end - begin; ++k) {
            size_t to = with[k], next; /* the nearest may be hidden by a third, but not for ever: it comes nearer */
            while ((next = nearest_beside(heap, to, with, end - begin)) != to)
                to = next;
            if (to != (size_t)with[k])
                move_bridge(heap, with[k], to, film);
        }
    }
}

/* -- Liquid ---------------------------------------------------------------------------------------------------------- */

static double other_radius(const pendular_yade_heap *heap, size_t n)
{
    return is_wall(heap, n) ? INFINITY : heap->radius[heap->second[n]];
}

static const pendular_table *table_of(const pendular_yade_heap *heap, size_t n)
{
    return is_wall(heap, n) ? heap->walls : heap->grains;
}

/* Rupture distance of a pair with so much liquid; NaN if its table does not know it. */
static double end_of(const pendular_yade_heap *heap, size_t n, double volume)
{
    return pendular_table_rupture_distance(table_of(heap, n), volume, heap->radius[heap->first[n]], other_radius(heap, n),
        heap->surface_tension);
}

/* The liquid of a bridge that broke, back to its grains. */
static void give_back(const pendular_yade_heap *heap, size_t n, double volume, double *film)
{
    film[heap->first[n]] += is_wall(heap, n) ? volume : 0.5 * volume;
    film[heap->second[n]] += is_wall(heap, n) ? 0.0 : 0.5 * volume;
}

/* A new bridge takes at most so much, in proportion to what its grains offer; whether it forms, or -1 out of range. */
static int take(pendular_yade_heap *heap, size_t n, double most, const double *offer, double *film)
{
    const int32_t i = heap->first[n], j = heap->second[n];
    const double others = is_wall(heap, n) ? 0.0 : offer[j], sum = offer[i] + others, held = sum < most ? sum : most;
    const double end = held > 0.0 ? end_of(heap, n, held) : 0.0;
    double towards[3];
    if (end != end && held == most)
        return -1;
    if (!(end > 0.0 && apart(heap, n, towards) < end)) /* or too little for the table */
        return 0;
    heap->volumes[n] = held;
    film[i] -= held * (offer[i] / sum);
    film[j] -= held * (others / sum);
    return 1;
}

/* Liquid between the films on the grains and the bridges: one that broke leaves half of it on each grain, and all of it on
   a grain at a wall; what a grain offers, a share of its film, is parted evenly among the bridges that form on it. `offer`
   is room for a number of each body. */
int pendular_yade_exchange(pendular_yade_heap *heap, double most, double share, double *film, double *offer)
{
    enum { NONE = 0, STANDS = 1, FORMS = 2 };
    unsigned char *has_bridge = heap->has_bridge;
    double towards[3];
    size_t n;
    memset(offer, 0, heap->bodies * sizeof *offer);
    for (n = 0; n < heap->pairs; ++n) {
        const double gap = apart(heap, n, towards);
        if (has_bridge[n] != NONE && !(gap < end_of(heap, n, heap->volumes[n]))) {
            give_back(heap, n, heap->volumes[n], film);
            heap->volumes[n] = 0.0;
            has_bridge[n] = NONE;
        } else if (has_bridge[n] == NONE && !heap->is_hidden[n]
            && (gap <= 0.0 || (heap->forms_apart && gap < end_of(heap, n, most)))) {
            has_bridge[n] = FORMS;
            offer[heap->first[n]] += 1.0;
            offer[heap->second[n]] += 1.0;
        }
    }
    for (n = 0; n < heap->bodies; ++n)
        offer[n] = offer[n] > 0.0 && film[n] > 0.0 ? share * film[n] / offer[n] : 0.0;
    for (n = 0; n < heap->pairs; ++n) {
        int forms;
        if (has_bridge[n] != FORMS)
            continue;
        forms = take(heap, n, most, offer, film);
        if (forms < 0) {
            heap->out_of_range = n;
            return OUT_OF_RANGE;
        }
        has_bridge[n] = forms ? STANDS : NONE;
    }
    return 0;
}

/* -- Forces ---------------------------------------------------------------------------------------------------------- */

/* Add the forces of all bridges; a pair that touches gets one, if bridges take no liquid from films, and one that broke has
   none. */
int pendular_yade_step(pendular_yade_heap *heap, double control, double *forces, double *separation, double *attraction)
{
    const size_t bodies = heap->bodies;
    size_t n;
    int k;
    for (n = 0; n < heap->pairs; ++n) {
        const int32_t i = heap->first[n], j = heap->second[n];
        double towards[3], pull;
        const double gap = apart(heap, n, towards);
        separation[n] = gap;
        attraction[n] = 0.0;
        if (heap->is_hidden[n] || (!heap->has_bridge[n] && (heap->volumes || (gap > 0.0 && !heap->forms_apart))))
            continue;
        pull = pendular_table_force(table_of(heap, n), gap, heap->volumes ? heap->volumes[n] : control, heap->radius[i],
            other_radius(heap, n), heap->surface_tension);
        if (pull != pull) {
            heap->out_of_range = n;
            return OUT_OF_RANGE;
        }
        heap->has_bridge[n] = heap->volumes || gap <= 0.0 || pull != 0.0;
        attraction[n] = pull;
        for (k = 0; k < 3; ++k) {
            forces[k * bodies + i] += pull * towards[k];
            forces[k * bodies + j] -= pull * towards[k];
        }
    }
    return 0;
}
