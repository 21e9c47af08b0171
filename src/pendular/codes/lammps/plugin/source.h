/* Where the numbers of bridges come from: a table in a file, or the exact solver. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_SOURCE_H
#define PENDULAR_LAMMPS_SOURCE_H

#include <memory>
#include <mpi.h>
#include <string>

#include "bridge.h"

namespace pendular_lammps {

/* Two solids; a plane has radius INFINITY. The first contact angle belongs to the first. */
struct Solids {
    double radius1, radius2;
};

/* All answers are NaN out of range. The separation of solids that overlap is negative: they have the bridge of solids
   that touch. */
class Source {
public:
    virtual ~Source() = default;

    virtual bool holds(int control) const = 0;
    virtual bool is_of_two_angles() const = 0;

    /* Separation at which the bridge breaks, 0 where there is none. */
    virtual double rupture(int control, double held, const Solids &, double tension) const = 0;

    /* Attraction before rupture. What is learnt on the way is kept in the bridge, for the next time. */
    virtual double pull(int control, Bridge &, const Solids &, double tension, double separation) const = 0;

    /* Potential before rupture: minus the work that breaks the bridge. */
    virtual double energy(int control, double held, const Solids &, double tension, double separation) const = 0;

    /* Volume under suction, suction at constant volume. */
    virtual double liquid(int control, double held, const Solids &, double tension, double separation) const = 0;

    /* Why an answer was NaN. */
    virtual std::string refusal(int control, double held, const Solids &, double tension) const = 0;
};

/* The table of a file, which the first rank reads; on failure empty, with the reason. */
std::shared_ptr<const Source> table_of_file(const std::string &path, MPI_Comm world, std::string &reason);

std::shared_ptr<const Source> exact_solver(double contact_angle1, double contact_angle2);

}    // namespace pendular_lammps

#endif
