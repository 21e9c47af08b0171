/* What all bridges between two kinds of solids obey. SPDX-License-Identifier: BSD-3-Clause */
#include "law.h"

#include <cstring>

#include "error.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

using namespace LAMMPS_NS;

namespace pendular_lammps {
namespace {
    constexpr double DEGREE = 3.14159265358979323846 / 180.0;
    const char *const UNITS[] = {"si", "cgs", "micro", "nano", "lj"};
}    // namespace

Law::Law(LAMMPS *lmp, std::string who) : Pointers(lmp), who(std::move(who)) {}

void Law::refuse(const std::string &what) const
{
    error->all(FLERR, "{}: {}", who, what);
}

double Law::number(const char *text) const
{
    return utils::numeric(FLERR, text, false, lmp);
}

double Law::positive(const char *name, const char *text) const
{
    const double value = number(text);
    if (!(value > 0.0 && std::isfinite(value)))
        refuse(fmt::format("{} {} is not > 0", name, text));
    return value;
}

int Law::read(int narg, char **arg)
{
    int i = read_source(narg, arg);
    while (i < narg) {
        const std::string word = arg[i];
        const bool is_held = word == "suction" || word == "volume" || word == "humidity";
        const bool is_known = is_held || word == "surface_tension" || word == "formation" || word == "reach"
            || word == "kelvin_pressure" || word == "viscosity" || word == "smallest_gap";
        if (!is_known)
            break;
        if (i + 1 >= narg)
            refuse(word + ": a number is missing after it");
        if (is_held)
            read_held(narg - i, arg + i);
        else if (word == "surface_tension")
            tension = positive("surface_tension", arg[i + 1]);
        else if (word == "kelvin_pressure")
            kelvin_pressure = positive("kelvin_pressure", arg[i + 1]);
        else if (word == "viscosity")
            viscosity = positive("viscosity", arg[i + 1]);
        else if (word == "smallest_gap")
            smallest_gap = positive("smallest_gap", arg[i + 1]);
        else {
            const double value = number(arg[i + 1]);
            if (!(value >= 0.0 && std::isfinite(value)))
                refuse(fmt::format("{} {} is not >= 0", word, arg[i + 1]));
            (word == "formation" ? formation : reach) = value;
        }
        i += 2;
    }
    if (tension < 0.0)
        refuse("surface_tension is missing");
    if (kind < 0)
        refuse("what is held is missing: suction, volume or humidity");
    if (is_viscous() != (smallest_gap > 0.0))
        refuse("viscosity and smallest_gap go together: without a smallest gap the force has no bound");
    if (!source->holds(kind))
        refuse(fmt::format("the table is one of a held {}, and cannot hold the {}",
            kind == PENDULAR_SUCTION ? "volume" : "suction", kind == PENDULAR_SUCTION ? "suction" : "volume"));
    refresh();
    return i;
}

int Law::read_source(int narg, char **arg)
{
    if (narg < 1)
        refuse("a table of bridges is missing, or 'exact contact_angle'");
    if (std::strcmp(arg[0], "exact") != 0) {
        std::string reason;
        source = table_of_file(arg[0], world, reason);
        if (!source)
            refuse(fmt::format("{}: {}", arg[0], reason));
        return 1;
    }
    if (narg < 3 || std::strcmp(arg[1], "contact_angle") != 0)
        refuse("exact: contact_angle is missing after it, in degrees");
    double angle[2];
    const int given = narg > 3 && utils::is_double(arg[3]) ? 2 : 1;
    for (int k = 0; k < 2; ++k) {
        const char *text = arg[2 + (k < given ? k : 0)];
        angle[k] = number(text);
        if (!(angle[k] >= 0.0 && angle[k] < 180.0))
            refuse(fmt::format("contact_angle {} is not in [0, 180) degrees", text));
    }
    source = exact_solver(DEGREE * angle[0], DEGREE * angle[1]);
    return 2 + given;
}

int Law::read_held(int narg, char **arg)
{
    if (kind >= 0)
        refuse(fmt::format("{}: one quantity is held, and another was given before", arg[0]));
    kind = std::strcmp(arg[0], "volume") == 0 ? PENDULAR_VOLUME : PENDULAR_SUCTION;
    if (std::strcmp(arg[0], "humidity") == 0 && kelvin_pressure < 0.0) {
        if (narg < 4 || std::strcmp(arg[2], "kelvin_pressure") != 0)
            refuse("humidity: kelvin_pressure is missing after it, R T over the molar volume of the liquid");
        kelvin_pressure = positive("kelvin_pressure", arg[3]);
    }
    if (utils::strmatch(arg[1], "^v_"))
        variable = arg[1] + 2;
    else
        now_held = value_of(number(arg[1]));
    return 2;
}

/* Suction or volume: Kelvin's equation turns a humidity into a suction. */
double Law::value_of(double given) const
{
    if (kelvin_pressure < 0.0) {
        if (kind == PENDULAR_VOLUME && !(given > 0.0 && std::isfinite(given)))
            refuse(fmt::format("volume {:.6g} is not > 0", given));
        if (!std::isfinite(given))
            refuse(fmt::format("suction {:.6g} is not a number", given));
        return given;
    }
    if (!(given > 0.0 && given < 1.0))
        refuse(fmt::format("humidity {:.6g} is not in (0, 1)", given));
    return -kelvin_pressure * std::log(given);
}

bool Law::refresh()
{
    if (variable.empty())
        return false;
    const int index = input->variable->find(variable.c_str());
    if (index < 0 || !input->variable->equalstyle(index))
        refuse(fmt::format("variable {} is not there, or not of equal style", variable));
    modify->clearstep_compute();
    const double value = value_of(input->variable->compute_equal(index));
    modify->addstep_compute(update->ntimestep + 1);
    const bool is_changed = value != now_held;
    now_held = value;
    return is_changed;
}

double Law::rupture(double held, const Solids &solids) const
{
    return source->rupture(kind, held, solids, tension);
}

double Law::range(const Solids &solids) const
{
    if (reach >= 0.0)
        return std::fmax(reach, formation);
    const double end = rupture(now_held, solids);
    if (std::isnan(end))
        refuse(refusal(now_held, solids));
    return std::fmax(end, formation);
}

double Law::renew(Bridge &bridge, double held, const Solids &solids) const
{
    bridge.held = held;
    bridge.rupture = rupture(held, solids);
    bridge.slope = NAN;
    if (!(bridge.rupture > 0.0))
        return bridge.rupture; /* no bridge, or no number */
    return source->pull(kind, bridge, solids, tension, 0.0);
}

double Law::pull(Bridge &bridge, const Solids &solids, double touching, double separation) const
{
    if (separation >= bridge.rupture)
        return 0.0;
    return separation <= 0.0 ? touching : source->pull(kind, bridge, solids, tension, separation);
}

double Law::force(double held, const Solids &solids, double separation) const
{
    Bridge bridge;
    const double touching = renew(bridge, held, solids);
    return pull(bridge, solids, touching, separation);
}

double Law::energy(double held, const Solids &solids, double separation) const
{
    return source->energy(kind, held, solids, tension, separation);
}

double Law::volume(double held, const Solids &solids, double separation) const
{
    return is_drained() ? source->liquid(kind, held, solids, tension, separation) : held;
}

double Law::suction(double held, const Solids &solids, double separation) const
{
    return is_drained() ? held : source->liquid(kind, held, solids, tension, separation);
}

double Law::drag(double held, const Solids &solids, double separation, double speed) const
{
    const double gap = std::fmax(separation, smallest_gap);
    return speed * pendular_damping(gap, volume(held, solids, separation), solids.radius1, solids.radius2, viscosity);
}

std::string Law::refusal(double held, const Solids &solids) const
{
    return source->refusal(kind, held, solids, tension);
}

void check_units(LAMMPS *lmp, const std::string &who)
{
    for (const char *name : UNITS)
        if (std::strcmp(lmp->update->unit_style, name) == 0)
            return;
    lmp->error->all(FLERR, "{}: in units {} a pressure is not a force over an area; use si, cgs, micro, nano or lj", who,
        lmp->update->unit_style);
}

}    // namespace pendular_lammps
