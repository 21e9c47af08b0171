/* One bridge in one step, as plain numbers and functions of them: for the loop of the pair style, and for a device, where
   an accelerated style would ask them from its functor. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_CONTACT_H
#define PENDULAR_LAMMPS_CONTACT_H

#include "pendular_viscous.h"

namespace pendular_lammps {

/* What a step asks of a bridge whose solids overlap, as most do: these lie side by side, in the order of i. */
struct Ends {
    int i, j;        /* local atom; local atom or ghost */
    double sum;      /* of the radii, NaN if the bridge has to be made anew */
    double touching; /* attraction at contact */
};

/* What a step asks of a bridge of solids apart besides. Between two events a force is a square root and a polynomial of one
   variable: that of the table in the cell where the bridge was last looked at. It is made anew when the bridge leaves the
   cell, or what it holds or a radius changes. */
struct Cell {
    double rupture = 0.0; /* separation at which it breaks */
    double offset = 0.0, slope = 0.0, bend = 0.0, series[PENDULAR_TABLE_LANES] = {};
};

/* Attraction within the cell, NaN beyond. */
PENDULAR_FUNCTION double pull_in_cell(const Cell &cell, double separation)
{
    const double share = separation / cell.rupture;
    const double t = cell.offset + cell.slope * sqrt((1.0 - share) / (1.0 + cell.bend * share));
    double total = cell.series[PENDULAR_TABLE_LANES - 1];
    if (!(fabs(t) <= 1.0 + 1e-9))
        return NAN;
    for (int k = PENDULAR_TABLE_LANES - 2; k >= 0; --k)
        total = total * t + cell.series[k];
    return total;
}

/* Attraction at a distance of the centres: 0 from the rupture distance on, NaN where the cell has to be made anew. */
PENDULAR_FUNCTION double pull_of(const Ends &ends, const Cell &cell, double distance)
{
    const double separation = distance - ends.sum;
    if (separation <= 0.0)
        return ends.touching;
    return separation >= cell.rupture ? 0.0 : pull_in_cell(cell, separation);
}

}    // namespace pendular_lammps

#endif
