/* A bridge, as it is kept from step to step on the rank that reckons with it. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_BRIDGE_H
#define PENDULAR_LAMMPS_BRIDGE_H

#include <cmath>
#include <memory>

#include "contact.h"
#include "lmptype.h"
#include "pendular.h"

namespace pendular_lammps {

class Law;

struct Bridge : Cell {
    Law *law = nullptr;
    LAMMPS_NS::tagint tag1 = 0, tag2 = 0;
    double held = 0.0;                     /* suction or volume */
    std::unique_ptr<pendular_state> state; /* to start from, where the solver is asked */
};

}    // namespace pendular_lammps

#endif
