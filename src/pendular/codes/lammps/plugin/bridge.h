/* A bridge, as it is kept from step to step on the rank that reckons with it. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_BRIDGE_H
#define PENDULAR_LAMMPS_BRIDGE_H

#include <cmath>
#include <memory>

#include "lmptype.h"
#include "pendular.h"

namespace pendular_lammps {

class Law;

/* Between two events a force is a square root and a polynomial of one variable: that of the table in the cell where the
   bridge was last looked at. It is made anew when the bridge leaves the cell, or what it holds or a radius changes. */
struct Bridge {
    static constexpr int TERMS = 8;

    Law *law = nullptr;
    LAMMPS_NS::tagint tag1 = 0, tag2 = 0;
    double held = 0.0;    /* suction or volume */
    double rupture = 0.0; /* separation at which it breaks */
    double offset = 0.0, slope = 0.0, bend = 0.0, series[TERMS] = {};
    std::unique_ptr<pendular_state> state; /* to start from, where the solver is asked */

    /* Attraction within the cell, NaN beyond. */
    double pull(double separation) const
    {
        const double share = separation / rupture;
        const double t = offset + slope * std::sqrt((1.0 - share) / (1.0 + bend * share));
        double total = series[TERMS - 1];
        if (!(std::fabs(t) <= 1.0 + 1e-9))
            return NAN;
        for (int k = TERMS - 2; k >= 0; --k)
            total = total * t + series[k];
        return total;
    }
};

/* What the loop over all bridges needs of one whose solids overlap, as most do. */
struct Ends {
    int i, j;        /* local atom; local atom or ghost */
    double sum;      /* of the radii, NaN if the bridge has to be made anew */
    double touching; /* attraction at contact */
};

}    // namespace pendular_lammps

#endif
