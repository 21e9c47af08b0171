/* Which grains have a bridge, kept with the grains while they move from rank to rank, and in restart files. The pair
   style makes this fix. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_FIX_BRIDGES_H
#define PENDULAR_LAMMPS_FIX_BRIDGES_H

#include <utility>
#include <vector>

#include "fix.h"

namespace pendular_lammps {

class PairPendular;

/* A bridge as one of its grains knows it. */
struct Partner {
    LAMMPS_NS::tagint tag;
    int former;  /* number of the bridge in the list before, -1 on another rank */
    double held; /* its volume; minus that, or 0 within a run, if a reservoir holds its suction */
};

class FixBridges : public LAMMPS_NS::Fix {
public:
    static constexpr const char *NAME = "PENDULAR_BRIDGES";

    PairPendular *pair = nullptr; /* whose bridges these are */

    FixBridges(LAMMPS_NS::LAMMPS *, int, char **);
    ~FixBridges() override;

    /* The pair style goes on with the bridges in its list. */
    void fall_behind() { is_behind = true; }

    /* Bridges of a local atom, known before and after atoms change places. */
    const Partner *begin(int i) const { return pool.data() + rows[i].first; }
    const Partner *end(int i) const { return begin(i) + rows[i].count; }

    int setmask() override;
    void init() override;
    void pre_exchange() override;
    void min_pre_exchange() override { pre_exchange(); }
    void setup_post_neighbor() override { post_neighbor(); }
    void post_neighbor() override;
    void min_post_neighbor() override { post_neighbor(); }
    void post_run() override { keep_volumes(); }

    void grow_arrays(int) override;
    void copy_arrays(int, int, int) override;
    void set_arrays(int) override;
    int pack_reverse_comm_size(int, int) override;
    int pack_reverse_comm(int, int, double *) override;
    void unpack_reverse_comm(int, int *, double *) override;
    int pack_exchange(int, double *) override;
    int unpack_exchange(int, double *) override;
    void write_restart(FILE *) override;
    int pack_restart(int, double *) override;
    void unpack_restart(int, int) override;
    int size_restart(int) override;
    int maxsize_restart() override;
    double memory_usage() override;

private:
    /* The partners of an atom in the pool. */
    struct Row {
        int first = 0, count = 0;
    };

    std::vector<Partner> pool;
    std::vector<Row> rows;
    std::vector<LAMMPS_NS::tagint> known_as; /* id that the partners have of an atom */
    int most = 0; /* partners of an atom */
    int local = 0, all = 0; /* atoms when the list was built */
    bool is_behind = false; /* the pair style has gone on since the atoms got their partners */
    std::vector<std::pair<int, int>> moves; /* since then, from place to place; from -1 if the atom is a new one */
    bool counts_only = false, volumes_wanted = false;

    void keep_volumes();
    void follow_moves();
    void fill();
    void add(int, const Partner &);
    int pack(int, double *) const;
    int unpack(int, const double *);
};

}    // namespace pendular_lammps

#endif
