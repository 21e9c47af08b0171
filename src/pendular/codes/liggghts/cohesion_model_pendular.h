/* Capillary bridges between grains, and between grains and walls, as a cohesion model of LIGGGHTS 3.8: exact, from a table
   that `pendular export table` wrote. See docs/liggghts.md.

     fix         tension all property/global surfaceTension scalar 0.0728
     fix         suction all property/global bridgeSuction scalar 5e3
     pair_style  gran model hertz tangential history cohesion pendular viscosity 1e-3 smallest_gap 1e-6
     fix         floor all wall/gran model hertz tangential history cohesion pendular primitive type 1 zplane 0.0

   Grains of types I <= J have their table in pendular_I_J.bridges, or else in pendular.bridges. A table at constant volume
   asks for bridgeVolume, the liquid of each bridge, in the place of bridgeSuction; with `film on` that is the most that a
   bridge takes from its grains. If the contact angles of a table differ, the first is that of type I. What stands behind
   `cohesion pendular` in pair_style holds for walls too.

   A bridge forms where two surfaces touch, and lives to its rupture distance. What is out of the range of a table ends the
   run with one line.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. LIGGGHTS is
   under the GNU General Public License, and so is a program that is built of both. */
#ifdef COHESION_MODEL
COHESION_MODEL(COHESION_PENDULAR,pendular,40)
#else
#ifndef COHESION_MODEL_PENDULAR_H_
#define COHESION_MODEL_PENDULAR_H_

#include "contact_models.h"
#include "cohesion_model_base.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "global_properties.h"
#include "neighbor.h"

#include "pendular_films.h"
#include "pendular_viscous.h"
#include "pendular_walls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace MODEL_PARAMS
{
    inline static ScalarProperty *createBridgeSuction(PropertyRegistry &registry, const char *caller, bool)
    {
        return createScalarProperty(registry, "bridgeSuction", caller);
    }

    inline static ScalarProperty *createBridgeVolume(PropertyRegistry &registry, const char *caller, bool)
    {
        return createScalarProperty(registry, "bridgeVolume", caller);
    }
}

namespace pendular_liggghts
{

/* What pair_style says, and what the models of pairs and of walls have in common. */
struct Shared {
    bool has_pairs, has_film;
    double viscosity, smallest_gap;
    Films films;
    WallBridges walls;

    explicit Shared(LAMMPS *lmp) :
        has_pairs(false), has_film(false), viscosity(0.0), smallest_gap(0.0), films(lmp), walls(lmp)
    {}

    static Shared &of(LAMMPS *lmp)
    {
        static std::map<LAMMPS *, Shared> all;
        return all.insert(std::make_pair(lmp, Shared(lmp))).first->second;
    }
};

}

namespace LIGGGHTS
{
namespace ContactModels
{

template<>
class CohesionModel<COHESION_PENDULAR> : public CohesionModelBase, private pendular_liggghts::BridgeMaker
{
public:
    CohesionModel(LAMMPS *lmp, IContactHistorySetup *history, ContactModelBase *model) :
        CohesionModelBase(lmp, history, model),
        is_wall_(model && model->is_wall()),
        types_(0),
        held_(is_wall_ ? -1 : history->add_history_value("pendular_bridge", "0")),
        surface_tension_(0.0),
        suction_(0.0),
        volume_(0.0),
        shared_(pendular_liggghts::Shared::of(lmp))
    {
        shared_.has_pairs = shared_.has_pairs || !is_wall_;
    }

    ~CohesionModel()
    {
        for (size_t i = 0; i < tables_.size(); ++i)
            pendular_table_close(&tables_[i]);
        shared_.has_pairs = shared_.has_pairs && is_wall_;
    }

    void registerSettings(Settings &settings)
    {
        bool is_reduced; /* other cohesion models have this word, and LIGGGHTS gives it to all */
        settings.registerOnOff("tangential_reduce", is_reduced, false);
        if (is_wall_)
            return;
        settings.registerDoubleSetting("viscosity", shared_.viscosity, 0.0);
        settings.registerDoubleSetting("smallest_gap", shared_.smallest_gap, 0.0);
        settings.registerOnOff("film", shared_.has_film, false);
        settings.registerDoubleSetting("share", shared_.films.share, 1.0);
    }

    void postSettings(IContactHistorySetup *, ContactModelBase *) {}

    void connectToProperties(PropertyRegistry &registry)
    {
        open_tables(registry.max_type());
        registry.registerProperty("surfaceTension", &MODEL_PARAMS::createSurfaceTension);
        registry.connect("surfaceTension", surface_tension_, "cohesion_model pendular");
        if (has_control(0)) {
            registry.registerProperty("bridgeSuction", &MODEL_PARAMS::createBridgeSuction);
            registry.connect("bridgeSuction", suction_, "cohesion_model pendular");
        }
        if (has_control(1)) {
            registry.registerProperty("bridgeVolume", &MODEL_PARAMS::createBridgeVolume);
            registry.connect("bridgeVolume", volume_, "cohesion_model pendular");
        }
        if (force->cg_active())
            error->cg(FLERR, "cohesion model pendular");
        if (is_wall_ && !shared_.has_pairs)
            fail("a wall has it, and so has to have pair_style gran");
        if (!is_wall_)
            read_shared();
        neighbor->register_contact_dist_factor(1.0 + reach(registry.min_radius(), registry.max_radius()));
    }

    void beginPass(SurfacesIntersectData &contact, ForceData &, ForceData &)
    {
        if (!contact.computeflag)
            return;
        if (neighbor->ago == 0)
            shared_.films.return_lost(static_cast<PairGran *>(force->pair_match("gran", 0)), held_);
        shared_.walls.begin_pass(shared_.films);
    }

    void endPass(SurfacesIntersectData &contact, ForceData &, ForceData &)
    {
        if (contact.computeflag && shared_.films.are_there())
            shared_.films.form_bridges(*this, held_);
    }

    void endSurfacesIntersect(SurfacesIntersectData &, ForceData &, ForceData &) {}

    void surfacesIntersect(SurfacesIntersectData &contact, ForceData &on_i, ForceData &on_j)
    {
        if (contact.is_wall)
            pull_to_wall(contact, contact.r, on_i);
        else
            pull_together(contact, contact.r, on_i, on_j);
    }

    void surfacesClose(SurfacesCloseData &contact, ForceData &on_i, ForceData &on_j)
    {
        if (contact.is_wall)
            pull_to_wall(contact, std::sqrt(contact.rsq), on_i);
        else if (contact.contact_history[held_] != 0.0 || touch(contact))
            pull_together(contact, std::sqrt(contact.rsq), on_i, on_j);
    }

private:
    bool is_wall_;
    int types_;
    int held_; /* place in the history of a contact: liquid of its bridge, -1 if a reservoir gives it, 0 without one */
    double surface_tension_, suction_, volume_;
    std::vector<pendular_table> tables_;
    std::vector<int> table_of_; /* number of the table of two types */
    pendular_liggghts::Shared &shared_;

    /* -- What the input says ---------------------------------------------------------------------------------------- */

    void read_shared()
    {
        const double share = shared_.films.share;
        if (!(shared_.viscosity >= 0.0) || !(shared_.smallest_gap >= 0.0))
            fail("viscosity and smallest_gap are > 0");
        if ((shared_.viscosity > 0.0) != (shared_.smallest_gap > 0.0))
            fail("viscosity and smallest_gap go together: without a smallest gap the force has no bound");
        if (!(share > 0.0 && share <= 1.0))
            fail("share " + text_of(share) + " is not in (0, 1]");
        if (!shared_.has_film)
            shared_.films.leave_out();
        else if (!has_control(1))
            fail("film: a table at constant volume is missing, as a reservoir gives the liquid of all others");
        else if (!shared_.films.find())
            fail("film is not there; make it by 'fix ID all property/atom film scalar yes no no VOLUME'");
        shared_.walls.make_room();
    }

    static std::string text_of(double number)
    {
        char text[40];
        snprintf(text, sizeof text, "%g", number);
        return text;
    }

    /* -- Tables ----------------------------------------------------------------------------------------------------- */

    const pendular_table &table_of(int type1, int type2) const
    {
        return tables_[table_of_[(type1 - 1) * types_ + type2 - 1]];
    }

    bool has_control(int is_volume) const
    {
        for (size_t i = 0; i < tables_.size(); ++i)
            if (tables_[i].is_volume == is_volume)
                return true;
        return false;
    }

    void open_tables(int types)
    {
        if (types_ == types)
            return;
        types_ = types;
        table_of_.assign(types * types, -1);
        int common = -1;
        for (int i = 1; i <= types; ++i) {
            for (int j = i; j <= types; ++j) {
                const std::string own
                    = "pendular_" + std::to_string(i) + "_" + std::to_string(j) + ".bridges";
                int number = opened(own, false);
                if (number < 0)
                    number = common >= 0 ? common : (common = opened("pendular.bridges", true));
                if (i == j && tables_[number].sides == 2)
                    fail("solids of one type " + std::to_string(i) + " have one contact angle, but their table has two");
                table_of_[(i - 1) * types + j - 1] = table_of_[(j - 1) * types + i - 1] = number;
            }
        }
    }

    /* Number of the table of a file; -1 if there is no such file and it need not be there. */
    int opened(const std::string &path, bool is_needed)
    {
        pendular_table table;
        if (!is_needed) {
            FILE *file = fopen(path.c_str(), "rb");
            if (!file)
                return -1;
            fclose(file);
        }
        const int code = pendular_table_open(path.c_str(), &table);
        if (code != PENDULAR_TABLE_OK)
            fail(path + ": " + pendular_table_error(code));
        tables_.push_back(table);
        return static_cast<int>(tables_.size()) - 1;
    }

    /* LIGGGHTS 3.8 prints some of its errors as characters by chance; so the line goes to the standard error first. */
    std::string told(const std::string &reason) const
    {
        const std::string line = "cohesion model pendular: " + reason;
        fprintf(stderr, "%s\n", line.c_str());
        return line;
    }

    void fail(const std::string &reason) const
    {
        error->all(FLERR, (comm->me == 0 ? told(reason) : reason).c_str());
    }

    /* -- Bridges ---------------------------------------------------------------------------------------------------- */

    double control_of(const pendular_table &table) const
    {
        return table.is_volume ? volume_ : suction_;
    }

    /* What is held, or with films the most liquid up to that which the table knows: there may be less. */
    double known(const pendular_table &table, double radius1, double radius2) const
    {
        const double mean = 2.0 / (1.0 / radius1 + 1.0 / radius2);
        const double most = (1.0 - 1e-9) * table.reduced[1] * mean * mean * mean;
        return table.is_volume && shared_.has_film ? std::min(volume_, most) : control_of(table);
    }

    /* Largest rupture distance, over the sum of the radii of two grains or over the radius of one at a wall, and a quarter
       of it: for radii between those that are tried, and for bridges that break within a step. Pairs that the table does
       not know are refused where they touch. */
    double reach(double smallest, double largest) const
    {
        const int count = 33;
        double farthest = 0.0;
        for (int i = 1; i <= types_; ++i) {
            for (int j = i; j <= types_; ++j) {
                const pendular_table &table = table_of(i, j);
                for (int k = 0; k < count; ++k) {
                    const double radius1 = smallest + (largest - smallest) * k / (count - 1);
                    for (int l = 0; l < (is_wall_ ? 1 : count); ++l) {
                        const double radius2
                            = is_wall_ ? INFINITY : smallest + (largest - smallest) * l / (count - 1);
                        const double end = pendular_table_rupture_distance(
                            &table, known(table, radius1, radius2), radius1, radius2, surface_tension_);
                        if (end > 0.0)
                            farthest = std::max(farthest, end / (is_wall_ ? radius1 : radius1 + radius2));
                    }
                }
            }
        }
        return 1.25 * farthest;
    }

    std::string out_of_range(const pendular_table &table, double held, double radius1, double radius2) const
    {
        char text[400];
        snprintf(text, sizeof text,
            "the %s %g with radii %g and %g and surface tension %g is out of the range of its table: "
            "reduced %s %g to %g, radius ratio %g to %g",
            table.is_volume ? "bridgeVolume" : "bridgeSuction", held, radius1, radius2, surface_tension_,
            table.is_volume ? "volume" : "suction", table.reduced[0], table.reduced[1], table.radius_ratio[0],
            table.radius_ratio[1]);
        return text;
    }

    static double other_radius(const SurfacesCloseData &contact)
    {
        return contact.is_wall ? INFINITY : contact.radj;
    }

    /* Where the bridge of two solids lies in its table; not a number if that does not know it. */
    pendular_table_place place_of(const SurfacesCloseData &contact, double held) const
    {
        const pendular_table &table = table_of(contact.itype, contact.jtype);
        const double other = other_radius(contact);
        const bool is_first = contact.itype <= contact.jtype;
        return pendular_table_find(&table, table.is_volume ? held : suction_, is_first ? contact.radi : other,
            is_first ? other : contact.radi, surface_tension_);
    }

    /* Grains in touch, but for the rounding of places that differ between two copies of a contact. */
    static bool touch(const SurfacesCloseData &contact)
    {
        return contact.rsq <= contact.radsum * contact.radsum * (1.0 + 4e-12);
    }

    static double separation_of(const SurfacesCloseData &contact, double r)
    {
        return r - contact.radi - (contact.is_wall ? 0.0 : contact.radj);
    }

    /* Liquid of a bridge that forms, of what its grains offer: negative where a reservoir gives it, NaN for none. */
    double held_of(const SurfacesCloseData &contact, double offered) const
    {
        const pendular_table &table = table_of(contact.itype, contact.jtype);
        const double held = table.is_volume ? std::min(volume_, offered) : -1.0;
        const double end = place_of(contact, held).rupture;
        if (end != end && (!table.is_volume || held == volume_)) {
            const double control = table.is_volume ? held : suction_;
            error->one(FLERR, told(out_of_range(table, control, contact.radi, other_radius(contact))).c_str());
        }
        return end > 0.0 ? held : NAN;
    }

    /* Attraction of a bridge, with that of its viscosity; NaN from the rupture distance on. */
    double attraction_of(const SurfacesCloseData &contact, double held, double r) const
    {
        const pendular_table &table = table_of(contact.itype, contact.jtype);
        const pendular_table_place place = place_of(contact, held);
        const double separation = separation_of(contact, r);
        if (place.rupture != place.rupture) /* the suction was changed, or a radius */
            error->one(FLERR,
                told(out_of_range(table, table.is_volume ? held : suction_, contact.radi, other_radius(contact))).c_str());
        if (!pendular_table_is_bridge(&place, separation))
            return NAN;
        double attraction = pendular_table_force_at(&table, &place, separation, surface_tension_);
        if (shared_.viscosity > 0.0)
            attraction += drag_of(contact, table, place, held, r);
        return attraction;
    }

    double drag_of(const SurfacesCloseData &contact, const pendular_table &table, const pendular_table_place &place,
        double held, double r) const
    {
        const double separation = separation_of(contact, r);
        const double volume = table.is_volume
            ? held
            : pendular_table_of_bridge(&table, PENDULAR_TABLE_LIQUID, &place, separation, surface_tension_);
        double speed = 0.0; /* at which they move apart */
        for (int k = 0; k < 3; ++k)
            speed += (contact.v_i[k] - contact.v_j[k]) * contact.delta[k] / r;
        return speed
            * pendular_damping(std::max(separation, shared_.smallest_gap), volume, contact.radi, other_radius(contact),
                shared_.viscosity);
    }

    /* -- Contacts --------------------------------------------------------------------------------------------------- */

    /* The vector of a contact runs from j, or the wall, to i. */
    void pull_together(SurfacesCloseData &contact, double r, ForceData &on_i, ForceData &on_j)
    {
        double &held = contact.contact_history[held_];
        if (held == 0.0)
            form(contact, held);
        if (held == 0.0)
            return;
        const double attraction = attraction_of(contact, held, r);
        if (attraction != attraction) {
            if (contact.computeflag)
                break_bridge(contact, held);
            return;
        }
        if (contact.contact_flags)
            *contact.contact_flags |= CONTACT_COHESION_MODEL;
        contact.has_force_update = true;
        for (int k = 0; k < 3; ++k) {
            const double part = -attraction * contact.delta[k] / r;
            on_i.delta_F[k] += part;
            on_j.delta_F[k] -= part;
        }
    }

    /* Where there are films, that waits for all contacts of the step. */
    void form(const SurfacesCloseData &contact, double &held)
    {
        if (!contact.computeflag)
            return;
        if (shared_.films.are_there() && table_of(contact.itype, contact.jtype).is_volume) {
            shared_.films.watch(contact);
            return;
        }
        const double found = held_of(contact, INFINITY);
        if (found == found)
            held = found;
    }

    void break_bridge(SurfacesCloseData &contact, double &held)
    {
        shared_.films.take(contact.i, 0.5 * held);
        shared_.films.take(contact.j, 0.5 * held);
        held = 0.0;
        if (contact.contact_flags)
            *contact.contact_flags &= ~CONTACT_COHESION_MODEL;
    }

    void pull_to_wall(SurfacesCloseData &contact, double r, ForceData &on_i)
    {
        const int i = contact.i;
        const double separation = separation_of(contact, r);
        const double way[3] = { -contact.delta[0] / r, -contact.delta[1] / r, -contact.delta[2] / r };
        pendular_liggghts::WallBridge *bridge = shared_.walls.find(i, way);
        if (!bridge && contact.computeflag && separation <= 0.0)
            bridge = wall_bridge(contact);
        if (!bridge)
            return;
        const bool is_told = !contact.computeflag; /* of a pass before */
        if (is_told ? !shared_.walls.is_here(i, bridge, way) : shared_.walls.is_elsewhere(i, bridge, separation))
            return;
        const double attraction = attraction_of(contact, bridge->held, r);
        if (attraction != attraction)
            return; /* broken, if no other part of the wall is nearer */
        double pull[3] = { attraction * way[0], attraction * way[1], attraction * way[2] };
        if (!is_told)
            shared_.walls.settle(i, bridge, way, separation, pull);
        contact.has_force_update = true;
        for (int k = 0; k < 3; ++k)
            on_i.delta_F[k] += pull[k];
    }

    /* A new one, or NULL. */
    pendular_liggghts::WallBridge *wall_bridge(const SurfacesCloseData &contact)
    {
        pendular_liggghts::Films &films = shared_.films;
        const bool is_fed = films.are_there() && table_of(contact.itype, contact.jtype).is_volume;
        const double offered = is_fed ? films.share * std::max(films.of(contact.i), 0.0) : INFINITY;
        const double held = offered > 0.0 ? held_of(contact, offered) : NAN;
        if (held != held)
            return NULL;
        pendular_liggghts::WallBridge *bridge = shared_.walls.add(contact.i, held);
        if (!bridge)
            error->one(FLERR, told("a grain touches walls in more than four directions").c_str());
        if (is_fed)
            films.of(contact.i) -= held;
        return bridge;
    }
};

}
}

#endif
#endif
