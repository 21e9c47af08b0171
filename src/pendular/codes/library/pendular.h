/* Capillary bridges between two solids, from the exact solution of the Young-Laplace equation.
   Written by Pendular ${version} (pendular export library), with libpendular.a and libpendular.so for ${processor}.

     #include "pendular.h"

     pendular_pair grains = { 50e-6, 50e-6, 0.35, 0.35, 0.0728 };
     pendular_state state;
     int status = pendular_bridge(PENDULAR_SUCTION, 1e-6, 5e3, &grains, &state);
     if (status == PENDULAR_FOUND)
         force = state.force;

   gcc main.c libpendular.a -lm

   SI units, or any one consistent set; angles in radians. The separation is from surface to surface, negative where the
   solids overlap. A plane has radius INFINITY. What is held is the suction, gas pressure minus liquid pressure, or the
   volume of the liquid.

   Nothing is kept between calls, and nothing shared: any number of threads may ask at once.

   C99, C++11, and all languages that call C. Needs the C library alone.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#ifndef PENDULAR_H
#define PENDULAR_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is held. */
enum { PENDULAR_SUCTION = 0, PENDULAR_VOLUME = 1 };

/* What is returned. All of a state is NaN unless its bridge is found. */
enum {
    PENDULAR_FOUND = 0,
    PENDULAR_NO_BRIDGE = 1, /* there is none: beyond rupture, or at this suction or volume of this pair */
    PENDULAR_FAILED = 2,    /* the solver did not find, or exclude, the bridge */
    PENDULAR_BAD_INPUT = 3  /* an argument is not a number, or out of range */
};

typedef struct {
    double radius1, radius2;               /* INFINITY is a plane */
    double contact_angle1, contact_angle2; /* through the liquid [rad], from 0 to below pi */
    double surface_tension;
} pendular_pair;

typedef struct {
    double separation;
    double curvature;           /* suction / surface tension */
    double force;               /* attraction */
    double volume;              /* of the liquid */
    double area;                /* of the meniscus */
    double across_tensor;       /* integral of n n over the meniscus: one of the two equal components across the axis, */
    double axial_tensor;        /* and that along it */
    double stiffness;           /* rate of the force in the separation, with the control held */
    double neck_radius;         /* NaN for a bridge that pushes */
    double neck_inside;         /* 1 if the neck lies between the solids, else 0 */
    double radius1;             /* of the contact circles */
    double radius2;
    double filling1;            /* half-filling angles [rad], 0 on a plane */
    double filling2;
    double wetted_area1;
    double wetted_area2;
    double middle_radius;       /* the meridian: radius and slope angle in the middle of its arc, */
    double middle_slope;
    double half_length;         /* and half its length */
    double unstable_directions; /* that keep the axis, under the control */
    double sideways_stable;     /* 1 if the liquid does not slip to one side, else 0 */
} pendular_state;

/* The stable bridge at a separation. */
int pendular_bridge(
    int control, double separation, double held, const pendular_pair *pair, pendular_state *state);

/* The same, sought first from the bridge that the state holds, as one of a step before: sooner if it is near. It may be
   of another separation, and a state of no bridge, with NaN, is none to start from. */
int pendular_bridge_near(
    int control, double separation, double held, const pendular_pair *pair, pendular_state *state);

/* The bridge at the end of its stable branch, where it breaks. */
int pendular_rupture(int control, double held, const pendular_pair *pair, pendular_state *state);

/* The same for rows, answered several at once in half the time. The status of each is stored, and the largest is
   returned. */
int pendular_bridges(int control, size_t count, const double *separation, const double *held,
    const pendular_pair *pairs, pendular_state *states, int *statuses);
int pendular_bridges_near(int control, size_t count, const double *separation, const double *held,
    const pendular_pair *pairs, pendular_state *states, int *statuses);
int pendular_ruptures(int control, size_t count, const double *held, const pendular_pair *pairs, pendular_state *states,
    int *statuses);

#ifdef __cplusplus
}
#endif

#endif
