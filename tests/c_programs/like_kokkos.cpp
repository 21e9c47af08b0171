/* A functor over the bridges of the plug-in for LAMMPS, as an accelerated style would have it. On a host the program asks it
   for rows of numbers from the standard input; for a GPU it is compiled alone.

   cell SUM TOUCHING RUPTURE OFFSET SLOPE and the eight terms of a series: the bridge that is asked from here on
   no_cell SUM TOUCHING: the same of one whose solids were never apart
   pull DISTANCE: attraction, and whether the host has to make the cell anew
   damping SEPARATION VOLUME RADIUS1 RADIUS2 VISCOSITY */
#include "contact.h"

#if defined(__CUDACC__) || defined(__HIPCC__)
#define ON_DEVICE __device__
#else
#define ON_DEVICE
#endif

using namespace pendular_lammps;

/* Attraction of each bridge, and whether the host has to make its cell anew, or the first one. */
struct BridgeFunctor {
    const Ends *ends;
    const int *cell; /* number of that of each bridge, -1 if it has none */
    const Cell *cells;
    const double *distance;
    double *pull;
    int *is_left_to_host;

    ON_DEVICE void operator()(int k) const
    {
        if (distance[k] <= ends[k].sum)
            pull[k] = ends[k].touching;
        else
            pull[k] = cell[k] < 0 ? NAN : pull_of(ends[k], cells[cell[k]], distance[k]);
        is_left_to_host[k] = pull[k] != pull[k];
    }
};

#if defined(__CUDACC__) || defined(__HIPCC__)
__global__ void over_bridges(BridgeFunctor functor, int count)
{
    for (int k = 0; k < count; ++k)
        functor(k);
}
#else
#include <cstdio>
#include <cstring>

int main()
{
    char kind[16];
    double a, b, c, d, e;
    Ends ends = {0, 1, 0.0, 0.0};
    Cell cell;
    int number = -1;
    while (std::scanf("%15s", kind) == 1) {
        if (std::strcmp(kind, "cell") == 0) {
            if (std::scanf("%lf %lf %lf %lf %lf", &ends.sum, &ends.touching, &cell.rupture, &cell.offset, &cell.slope) != 5)
                return 1;
            for (double &term : cell.series)
                if (std::scanf("%lf", &term) != 1)
                    return 1;
            number = 0;
        } else if (std::strcmp(kind, "no_cell") == 0) {
            if (std::scanf("%lf %lf", &ends.sum, &ends.touching) != 2)
                return 1;
            number = -1;
        } else if (std::strcmp(kind, "pull") == 0) {
            double pull;
            int is_left;
            if (std::scanf("%lf", &a) != 1)
                return 1;
            BridgeFunctor{&ends, &number, &cell, &a, &pull, &is_left}(0);
            std::printf("%.17g %d\n", pull, is_left);
        } else {
            if (std::scanf("%lf %lf %lf %lf %lf", &a, &b, &c, &d, &e) != 5)
                return 1;
            std::printf("%.17g\n", pendular_damping(a, b, c, d, e));
        }
    }
    return 0;
}
#endif
