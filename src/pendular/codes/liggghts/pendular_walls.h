/* Bridges of grains with walls in LIGGGHTS: a part of cohesion_model_pendular.h.

   LIGGGHTS asks a model for each triangle of a mesh near a grain: for faces, edges and corners, often for several of one
   smooth wall at once. A grain has one bridge where these lie in nearly one direction, with the nearest of them, and the
   bridge goes on while the grain rolls from one to the next, also to another mesh. So a bridge is known by its direction
   from the centre of the grain; it is kept with the grain, and not with a triangle.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#ifndef PENDULAR_LIGGGHTS_WALLS_H
#define PENDULAR_LIGGGHTS_WALLS_H

#include "pendular_films.h"
#include "neighbor.h"
#include "update.h"

namespace pendular_liggghts
{

/* As it is kept with a grain, in columns of a `fix property/atom`. */
struct WallBridge {
    double held;   /* its liquid, negative where a reservoir gives it; 0 where there is no bridge */
    double way[3]; /* unit vector from the grain to the wall */
    double pass;   /* over all walls, in which it was found last */
};

class WallBridges : protected Pointers
{
public:
    enum { MOST = 4 }; /* of a grain */

    explicit WallBridges(LAMMPS *lmp) : Pointers(lmp), bridges_(NULL), pass_(0.0) {}

    void make_room()
    {
        bridges_ = numbers_of_grains(
            modify, "pendular_walls", MOST * sizeof(WallBridge) / sizeof(double), "0.0", "yes", "no");
    }

    /* Bridges that no wall was near enough for, in the pass before, are broken. A run begins with another pass over the
       same places. */
    void begin_pass(Films &films)
    {
        if (neighbor->ago == 0)
            find_grains();
        for (size_t n = 0; n < grains_.size(); ++n)
            for (int i = grains_[n], k = 0; k < MOST; ++k) {
                WallBridge &bridge = of(i)[k];
                if (update->setupflag)
                    bridge.pass = -1.0;
                else if (bridge.held != 0.0 && bridge.pass != pass_) {
                    films.take(i, bridge.held);
                    bridge.held = 0.0;
                }
            }
        pass_ += 1.0;
        nearest_.resize(std::max(nearest_.size(), static_cast<size_t>(MOST) * atom->nlocal));
    }

    /* The bridge of a grain in nearly this direction, or NULL. */
    WallBridge *find(int i, const double *way)
    {
        const double nearly = 0.70710678118654752; /* cosine of 45 degrees */
        WallBridge *found = NULL;
        double most = nearly;
        for (int k = 0; k < MOST; ++k) {
            WallBridge &bridge = of(i)[k];
            const double cosine = way[0] * bridge.way[0] + way[1] * bridge.way[1] + way[2] * bridge.way[2];
            if (bridge.held != 0.0 && cosine > most) {
                most = cosine;
                found = &bridge;
            }
        }
        return found;
    }

    /* A new one, or NULL where there is no room. */
    WallBridge *add(int i, double held)
    {
        for (int k = 0; k < MOST; ++k) {
            WallBridge &bridge = of(i)[k];
            if (bridge.held != 0.0)
                continue;
            bridge.held = held;
            bridge.pass = -1.0;
            grains_.push_back(i);
            return &bridge;
        }
        return NULL;
    }

    /* Whether another part of the wall, as near or nearer, has the bridge in this pass. */
    bool is_elsewhere(int i, const WallBridge *bridge, double separation)
    {
        return bridge->pass == pass_ && nearest(i, bridge).separation <= separation;
    }

    /* Whether this part of the wall has the bridge. */
    bool is_here(int i, const WallBridge *bridge, const double *way)
    {
        return std::equal(way, way + 3, bridge->way) && bridge->pass == pass_;
    }

    /* Give the bridge to this part of the wall; `force` becomes what it adds to that which another part has given. */
    void settle(int i, WallBridge *bridge, const double *way, double separation, double *force)
    {
        Nearest &here = nearest(i, bridge);
        double former[3] = { 0.0, 0.0, 0.0 };
        if (bridge->pass == pass_)
            std::copy(here.force, here.force + 3, former);
        bridge->pass = pass_;
        here.separation = separation;
        for (int k = 0; k < 3; ++k) {
            bridge->way[k] = way[k];
            here.force[k] = force[k];
            force[k] -= former[k];
        }
    }

private:
    /* The part of a wall that has a bridge, in this pass. */
    struct Nearest {
        double separation, force[3];
    };

    FixPropertyAtom *bridges_;
    double pass_;
    std::vector<int> grains_; /* that have bridges, or had some since neighbours were sought */
    std::vector<Nearest> nearest_;

    void find_grains()
    {
        grains_.clear();
        for (int i = 0; i < atom->nlocal; ++i)
            for (int k = 0; k < MOST; ++k)
                if (of(i)[k].held != 0.0) {
                    grains_.push_back(i);
                    break;
                }
    }

    WallBridge *of(int i) { return reinterpret_cast<WallBridge *>(bridges_->array_atom[i]); }
    Nearest &nearest(int i, const WallBridge *bridge) { return nearest_[MOST * i + (bridge - of(i))]; }
};

}

#endif
