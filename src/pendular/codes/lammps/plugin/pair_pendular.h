/* Pair style pendular: capillary bridges between spheres. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_PAIR_PENDULAR_H
#define PENDULAR_LAMMPS_PAIR_PENDULAR_H

#include <memory>
#include <string>
#include <vector>

#include "bridge.h"
#include "film.h"
#include "fix_bridges.h"
#include "law.h"
#include "pair.h"

namespace pendular_lammps {

/* A pair without a bridge, and the square of the distance of the centres at which it may form one. */
struct Watched {
    int i, j;
    double near;
};

/* A bridge of the list before, as the first of its two atoms knows it. */
struct Kept {
    int i, j;
    const Partner *partner;
};

/* Each pair of grains is in the list of one rank, which alone decides whether they have a bridge. */
class PairPendular : public LAMMPS_NS::Pair {
public:
    Bridges bridges; /* of this rank */

    explicit PairPendular(LAMMPS_NS::LAMMPS *);
    ~PairPendular() override;

    void settings(int, char **) override;
    void coeff(int, char **) override;
    void init_style() override;
    double init_one(int, int) override;
    void compute(int, int) override;
    int pack_forward_comm(int, int *, double *, int, int *) override;
    void unpack_forward_comm(int, int, double *) override;
    int pack_reverse_comm(int, int, double *) override;
    void unpack_reverse_comm(int, int *, double *) override;
    double memory_usage() override;

    /* Find the bridges in a new neighbour list, and the pairs that may come near enough for one. */
    void take_list();

    void forget_history() { history = nullptr; }

    /* The two solids of a bridge as its law has them, and their separation. */
    Solids solids_of(const Law &, int i, int j) const;
    double separation_of(const Ends &) const;
    double square_of_distance(int i, int j) const; /* of the centres */

    /* Liquid in a bridge. */
    double volume_of(int number) const;

private:
    std::vector<std::shared_ptr<Law>> laws, retired;
    std::vector<std::vector<Law *>> law_of; /* by two types */
    std::vector<double> largest;            /* radius of each type */
    Bridges former, apart;                  /* of the list before, and while a list is made */
    std::vector<Watched> watched;           /* pairs that may come near enough for a bridge */
    std::vector<int> arrived;               /* numbers of those that are near enough */
    std::vector<int> broken;                /* numbers of bridges */
    std::vector<Candidate> forming;
    std::vector<double> on_ghosts; /* force, energy and virial, where LAMMPS does not bring them home */
    FixBridges *history = nullptr;
    LAMMPS_NS::Pair *lender = nullptr; /* whose list serves here, if there is one */
    Film film;
    bool radii_change = false;
    int homeward = 0; /* numbers of a ghost that are sent home, 0 if it is talked of films */

    void allocate();
    void retire_laws();
    void find_largest();
    void check_radii() const;
    void check_box() const;
    bool forms_apart() const;
    LAMMPS_NS::Pair *list_lender() const;
    void find_bridges();
    int place_of(const Partner &) const;
    void find_watched(const LAMMPS_NS::NeighList &near, int i);
    void take_over(const Kept &);
    void refresh();
    template <bool TALLIES, bool KEEPS_GHOSTS> void add_forces();
    double pull_at(int number, double distance);
    double renewed_pull(int number, double distance);
    void make(int number, Bridge &, const Solids &);
    void add_force(int number);
    void add_drags();
    double *other_end(int j);
    void tally(int number, double pull_over_distance, double dx, double dy, double dz);
    void watch(int i, int j);
    double nearness(int i, int j) const;
    void look_at_watched();
    bool is_joined(int i, int j);
    double held_by(int i, int j, Law &, double offered) const;
    void form(int i, int j, Law &, double held);
    void remove_broken();
    void exchange_film();
    void form_from_film();
    void return_lost();
    double *film_on_grains() const;
    void clear_ghosts();
    void bring_home();
    [[noreturn]] void refuse(int i, int j, const std::string &why) const;
};

}    // namespace pendular_lammps

#endif
