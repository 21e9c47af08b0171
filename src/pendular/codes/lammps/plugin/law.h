/* What all bridges between two kinds of solids obey, as a line of the input tells. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_LAW_H
#define PENDULAR_LAMMPS_LAW_H

#include "pointers.h"
#include "source.h"

namespace pendular_lammps {

/* FILE | exact contact_angle A [A2], then suction S | volume V | humidity H kelvin_pressure P, surface_tension G, and
   perhaps formation D, reach D, viscosity M smallest_gap D. What is held may be an equal-style variable, v_name. */
class Law : protected LAMMPS_NS::Pointers {
public:
    double formation = 0.0; /* separation at which a bridge forms */
    double reach = -1.0;    /* separation up to which bridges are looked for, negative if it is not given */

    /* Who asks is named in errors. */
    Law(LAMMPS_NS::LAMMPS *, std::string who);

    /* Number of words of the line that belong to the law. */
    int read(int narg, char **arg);

    /* Evaluate the variable; whether another value is held than before. All ranks have to ask. */
    bool refresh();

    double control() const { return now_held; }
    bool is_drained() const { return kind == PENDULAR_SUCTION; }
    bool is_of_two_angles() const { return source->is_of_two_angles(); }
    bool is_variable() const { return !variable.empty(); }

    double rupture(double held, const Solids &) const;

    /* Longest separation of these solids at which there may be a bridge, or one may form. */
    double range(const Solids &) const;

    /* Make a bridge anew: what it holds, its rupture distance, and the attraction at contact, which is returned. */
    double renew(Bridge &, double held, const Solids &) const;

    /* Attraction before rupture; 0 from there on. */
    double pull(Bridge &, const Solids &, double touching, double separation) const;

    /* The same, of a bridge without a record. */
    double force(double held, const Solids &, double separation) const;

    double energy(double held, const Solids &, double separation) const;
    double volume(double held, const Solids &, double separation) const;
    double suction(double held, const Solids &, double separation) const;

    bool is_viscous() const { return viscosity > 0.0; }

    /* Attraction of solids that move apart, by the viscosity of the liquid. */
    double drag(double held, const Solids &, double separation, double speed) const;

    /* Why there was no number. */
    std::string refusal(double held, const Solids &) const;

private:
    std::string who, variable;
    std::shared_ptr<const Source> source;
    int kind = -1;
    double tension = -1.0, now_held = NAN, kelvin_pressure = -1.0, viscosity = 0.0, smallest_gap = -1.0;

    int read_source(int narg, char **arg);
    int read_held(int narg, char **arg);
    double number(const char *text) const;
    double positive(const char *name, const char *text) const;
    double value_of(double given) const;
    [[noreturn]] void refuse(const std::string &what) const;
};

/* The forces on grains are those of bridges only where the units of force, pressure and length agree. */
void check_units(LAMMPS_NS::LAMMPS *, const std::string &who);

}    // namespace pendular_lammps

#endif
