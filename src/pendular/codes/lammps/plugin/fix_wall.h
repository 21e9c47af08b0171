/* Fix pendular/wall: bridges between grains and walls. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_FIX_WALL_H
#define PENDULAR_LAMMPS_FIX_WALL_H

#include <string>
#include <vector>

#include "bridge.h"
#include "film.h"
#include "fix.h"
#include "law.h"

namespace LAMMPS_NS {
class Region;
}

namespace pendular_lammps {

/* Two planes across an axis, or the faces of a region, which are planes to a grain. */
class FixWall : public LAMMPS_NS::Fix {
public:
    FixWall(LAMMPS_NS::LAMMPS *, int, char **);
    ~FixWall() override;

    int setmask() override;
    void init() override;
    void setup(int) override;
    void min_setup(int) override;
    void post_force(int) override;
    void min_post_force(int vflag) override { post_force(vflag); }
    double compute_scalar() override;
    double compute_vector(int) override;

    void grow_arrays(int) override;
    void copy_arrays(int, int, int) override;
    void set_arrays(int) override;
    int pack_exchange(int, double *) override;
    int unpack_exchange(int, double *) override;
    int pack_restart(int, double *) override;
    void unpack_restart(int, int) override;
    int size_restart(int) override;
    int maxsize_restart() override;
    double memory_usage() override;

private:
    enum Number { BRIDGES, LIQUID, FORCE_X, FORCE_Y, FORCE_Z, ENERGY, NUMBERS };

    /* A face near a grain: its number, the way to it from the grain, and its distance from the centre. */
    struct Face {
        int number;
        double way[3], distance;
    };

    /* A bridge of this step, for its energy. */
    struct Pulled {
        double radius, held, separation;
    };

    /* A bridge to a face. */
    struct Held {
        int face;
        double held;
    };

    Law law;
    Film film;
    int axis = -1;
    double place[2];               /* of the planes, INFINITY if there is none */
    std::string place_variable[2]; /* or by a variable */
    std::string region_name;
    LAMMPS_NS::Region *region = nullptr;
    bool takes_curved = false;
    int most = 2; /* bridges of a grain */

    std::vector<std::vector<Held>> held_by; /* of each atom */
    std::vector<double> kept;               /* its volume of liquid in these bridges, for output */
    std::vector<Face> faces;                /* near the grain that is looked at */
    std::vector<Pulled> pulled;
    Bridge bridge;                          /* of the last question */
    double sum = NAN, touching = NAN;
    double total[NUMBERS], total_of_all[NUMBERS];
    bool is_summed = false;

    int read_walls(int narg, char **arg);
    void read_place(int side, const char *text);
    void move();
    double range_of(int i) const;
    void find_faces(int i, double range);
    double attraction(int i, double held, double separation);
    double film_for(int i);
    void add_to_film(int i, double volume);
    void pull(int i, const Face &, double held);
    void look_at(int i);
    [[noreturn]] void refuse(const std::string &what) const;
};

}    // namespace pendular_lammps

#endif
