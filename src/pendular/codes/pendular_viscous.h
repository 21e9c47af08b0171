/* The viscous force of a bridge along its axis: the law `pitois2000`, for C99, C++11, CUDA and HIP.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#ifndef PENDULAR_VISCOUS_H
#define PENDULAR_VISCOUS_H

#include "pendular_table.h"

/* Attraction by the viscosity of the liquid, of solids that move apart, over their speed. A plane has radius INFINITY. */
PENDULAR_FUNCTION double pendular_damping(
    double separation, double volume, double radius1, double radius2, double viscosity)
{
    const double pi = 3.14159265358979323846, mean = 2.0 / (1.0 / radius1 + 1.0 / radius2), gap = separation / mean;
    const double x = 2.0 * (volume / (mean * mean * mean)) / (pi * (gap * gap)), root = sqrt(1.0 + x);
    const double part = x / (root * (1.0 + root));
    return viscosity * mean * (1.5 * pi * (part * part) / gap);
}

#endif
