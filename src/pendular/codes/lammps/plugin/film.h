/* Liquid on the grains, of which undrained bridges are made, and to which it returns. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_FILM_H
#define PENDULAR_LAMMPS_FILM_H

#include <string>
#include <vector>

#include "bridge.h"

namespace pendular_lammps {

/* A pair near enough for a bridge. */
struct Candidate {
    int i, j;
    Law *law;
};

/* The volumes are those of a `fix property/atom d_NAME`. In a step, each grain first gets half of the liquid of each of
   its bridges that broke; then what it offers, a share of its film, is parted evenly among the bridges that form on it.
   No number of a grain or a rank enters, and nothing is lost. The pair style does the talking between ranks. */
struct Film {
    enum Talk { FOUND, RETURNED, OFFERED, TAKEN }; /* what is sent between ranks */

    std::string name; /* empty: there is none, and bridges take their volume from nowhere */
    double share = 1.0;
    bool feeds_bridges = false; /* what returns goes to the other bridges of a grain, if it has any */

    Talk talk = FOUND;
    std::vector<double> returned, forming, standing; /* of each atom, ghosts too */
    std::vector<double> offered, gained, taken;

    bool is_there() const { return !name.empty(); }
    void clear(int atoms);
    int numbers() const; /* sent for an atom */
    int pack(int i, double *buffer) const;
    int add(int i, const double *buffer);
    int take(int i, const double *buffer);

    /* What an atom offers to each bridge that forms, and each of its bridges gains, from what it has. */
    void offer(int i, double &on_grain);
};

}    // namespace pendular_lammps

#endif
