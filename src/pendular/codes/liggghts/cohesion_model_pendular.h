/* Capillary bridges between grains, and between grains and flat walls, as a cohesion model of LIGGGHTS 3.8: exact, from a
   table that `pendular export table` wrote. See docs/liggghts.md.

     fix         tension all property/global surfaceTension scalar 0.0728
     fix         suction all property/global bridgeSuction scalar 5e3
     pair_style  gran model hertz tangential history cohesion pendular
     fix         floor all wall/gran model hertz tangential history cohesion pendular primitive type 1 zplane 0.0

   Grains of types I <= J have their table in pendular_I_J.bridges, or else in pendular.bridges. A table at constant volume
   asks for bridgeVolume, the liquid of each bridge, in the place of bridgeSuction. If the contact angles of a table differ,
   the first is that of type I.

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
#include "global_properties.h"
#include "neighbor.h"

#include "pendular_table.h"

#include <algorithm>
#include <cmath>
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

namespace LIGGGHTS
{
namespace ContactModels
{

template<>
class CohesionModel<COHESION_PENDULAR> : public CohesionModelBase
{
public:
    CohesionModel(LAMMPS *lmp, IContactHistorySetup *history, ContactModelBase *model) :
        CohesionModelBase(lmp, history, model),
        is_wall_(model && model->is_wall()),
        types_(0),
        bridge_(history->add_history_value("pendular_bridge", "0")),
        surface_tension_(0.0),
        suction_(0.0),
        volume_(0.0)
    {}

    ~CohesionModel()
    {
        for (size_t i = 0; i < tables_.size(); ++i)
            pendular_table_close(&tables_[i]);
    }

    void registerSettings(Settings &settings)
    {
        bool is_reduced; /* other cohesion models have this word, and LIGGGHTS gives it to all */
        settings.registerOnOff("tangential_reduce", is_reduced, false);
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
        neighbor->register_contact_dist_factor(1.0 + reach(registry.min_radius(), registry.max_radius()));
    }

    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endSurfacesIntersect(SurfacesIntersectData &, ForceData &, ForceData &) {}

    void surfacesIntersect(SurfacesIntersectData &contact, ForceData &on_i, ForceData &on_j)
    {
        contact.contact_history[bridge_] = 1.0;
        if (contact.contact_flags)
            *contact.contact_flags |= CONTACT_COHESION_MODEL;
        pull(contact, contact.r, force_of(contact, contact.r), on_i, on_j);
    }

    void surfacesClose(SurfacesCloseData &contact, ForceData &on_i, ForceData &on_j)
    {
        double &has_bridge = contact.contact_history[bridge_];
        if (has_bridge == 0.0)
            return;
        const double r = std::sqrt(contact.rsq), attraction = force_of(contact, r);
        if (attraction == 0.0) { /* broken */
            has_bridge = 0.0;
            if (contact.contact_flags)
                *contact.contact_flags &= ~CONTACT_COHESION_MODEL;
            return;
        }
        if (contact.contact_flags)
            *contact.contact_flags |= CONTACT_COHESION_MODEL;
        contact.has_force_update = true;
        pull(contact, r, attraction, on_i, on_j);
    }

private:
    bool is_wall_;
    int types_;
    int bridge_; /* place in the history of a contact: 1 while it has a bridge */
    double surface_tension_, suction_, volume_;
    std::vector<pendular_table> tables_;
    std::vector<int> table_of_; /* number of the table of two types */

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

    /* Largest rupture distance, over the sum of the radii of two grains or over the radius of one at a wall, with a margin
       for radii between those that are tried. Pairs that the table does not know are refused where they touch. */
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
                            &table, control_of(table), radius1, radius2, surface_tension_);
                        if (end > 0.0)
                            farthest = std::max(farthest, end / (is_wall_ ? radius1 : radius1 + radius2));
                    }
                }
            }
        }
        return 1.01 * farthest;
    }

    std::string out_of_range(const pendular_table &table, double radius1, double radius2) const
    {
        char text[400];
        snprintf(text, sizeof text,
            "the %s %g with radii %g and %g and surface tension %g is out of the range of its table: "
            "reduced %s %g to %g, radius ratio %g to %g",
            table.is_volume ? "bridgeVolume" : "bridgeSuction", control_of(table), radius1, radius2, surface_tension_,
            table.is_volume ? "volume" : "suction", table.reduced[0], table.reduced[1], table.radius_ratio[0],
            table.radius_ratio[1]);
        return text;
    }

    double force_of(const SurfacesCloseData &contact, double r) const
    {
        if (contact.is_wall && contact.mesh)
            error->one(FLERR, told("a wall is a plane, primitive xplane, yplane or zplane, and no mesh").c_str());
        const pendular_table &table = table_of(contact.itype, contact.jtype);
        const double other = contact.is_wall ? INFINITY : contact.radj;
        const bool is_first = contact.itype <= contact.jtype;
        const double separation = r - contact.radi - (contact.is_wall ? 0.0 : contact.radj);
        const double attraction = pendular_table_force(&table, separation, control_of(table),
            is_first ? contact.radi : other, is_first ? other : contact.radi, surface_tension_);
        if (attraction != attraction)
            error->one(FLERR, told(out_of_range(table, contact.radi, other)).c_str());
        return attraction;
    }

    /* The vector of a contact runs from j, or the wall, to i. */
    void pull(const SurfacesCloseData &contact, double r, double attraction, ForceData &on_i, ForceData &on_j) const
    {
        for (int k = 0; k < 3; ++k) {
            const double part = -attraction * contact.delta[k] / r;
            on_i.delta_F[k] += part;
            if (!contact.is_wall)
                on_j.delta_F[k] -= part;
        }
    }
};

}
}

#endif
#endif
