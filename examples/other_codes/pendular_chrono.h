/* Bridges of a table between spheres in Chrono: forces on accumulators of the bodies, before each step.

     PendularBridges bridges("w.bridges", 5e3, 0.0728);      what is held, surface tension
     bridges.add(body, radius);                              for each sphere
     while (system.GetChTime() < end) {
         bridges.apply();
         system.DoStepDynamics(step);
     }

   All pairs are looked at, which is enough for a few hundred grains; of more, give those that are near. A bridge forms in
   touch and lives to its rupture distance.

   Checked by the compiler against the headers of Chrono of August 2026; not linked, and not run.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#ifndef PENDULAR_CHRONO_H
#define PENDULAR_CHRONO_H

#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "chrono/physics/ChBody.h"

#include "pendular_table.h"

class PendularBridges
{
public:
    /* What is held is the suction or the volume, as the table has it. */
    PendularBridges(const std::string &path, double held, double surface_tension) :
        held_(held), surface_tension_(surface_tension)
    {
        const int code = pendular_table_open(path.c_str(), &table_);
        if (code != PENDULAR_TABLE_OK)
            throw std::runtime_error(path + ": " + pendular_table_error(code));
    }

    ~PendularBridges() { pendular_table_close(&table_); }
    PendularBridges(const PendularBridges &) = delete;
    PendularBridges &operator=(const PendularBridges &) = delete;

    void add(std::shared_ptr<chrono::ChBody> body, double radius)
    {
        grains_.push_back({ body, radius, body->AddAccumulator() });
    }

    void apply()
    {
        for (Grain &grain : grains_)
            grain.body->EmptyAccumulator(grain.accumulator);
        for (size_t i = 0; i < grains_.size(); ++i)
            for (size_t j = i + 1; j < grains_.size(); ++j)
                pull(i, j);
    }

private:
    struct Grain {
        std::shared_ptr<chrono::ChBody> body;
        double radius;
        unsigned accumulator;
    };

    pendular_table table_;
    double held_, surface_tension_;
    std::vector<Grain> grains_;
    std::set<std::pair<size_t, size_t>> bridges_;

    void pull(size_t i, size_t j)
    {
        const Grain &one = grains_[i], &other = grains_[j];
        const chrono::ChVector3d way = other.body->GetPos() - one.body->GetPos();
        const double distance = way.Length(), separation = distance - one.radius - other.radius;
        if (separation > 0.0 && !bridges_.count({ i, j }))
            return;
        const double force
            = pendular_table_force(&table_, separation, held_, one.radius, other.radius, surface_tension_);
        if (force != force)
            throw std::runtime_error("a bridge is out of the range of its table");
        if (force == 0.0) {
            bridges_.erase({ i, j });
            return;
        }
        bridges_.insert({ i, j });
        const chrono::ChVector3d pull = way * (force / distance);
        one.body->AccumulateForce(one.accumulator, pull, one.body->GetPos(), false);
        other.body->AccumulateForce(other.accumulator, -pull, other.body->GetPos(), false);
    }
};

#endif
