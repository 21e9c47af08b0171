// Exact bridges between many grains, in rows, and once more after a small step.
//
// pendular export library --out lib
// g++ -std=c++11 -O2 -I lib -o exact exact.cpp lib/libpendular.a
// ./exact
#include <cstdio>
#include <vector>

#include "pendular.h"

int main()
{
    const std::size_t count = 6;
    const std::vector<double> volumes(count, 5e-15);                                             // [m3]
    const std::vector<pendular_pair> grains(count, { 50e-6, 100e-6, 0.35, 0.35, 0.0728 });
    std::vector<pendular_state> states(count);
    std::vector<int> statuses(count);
    pendular_ruptures(PENDULAR_VOLUME, count, volumes.data(), grains.data(), states.data(), statuses.data());
    std::printf("breaks at %.17g m\n", states[0].separation);
    std::vector<double> separations(count);
    for (std::size_t i = 0; i < count; ++i)
        separations[i] = 0.21 * i * states[0].separation;
    pendular_bridges(PENDULAR_VOLUME, count, separations.data(), volumes.data(), grains.data(), states.data(),
        statuses.data());
    for (double &separation : separations)
        separation *= 1.01;
    pendular_bridges_near(PENDULAR_VOLUME, count, separations.data(), volumes.data(), grains.data(), states.data(),
        statuses.data());
    std::printf("separation [m], status, force [N], stiffness [N/m], curvature [1/m]\n");
    for (std::size_t i = 0; i < count; ++i)
        std::printf("%.17g %d %.17g %.17g %.17g\n", separations[i], statuses[i], states[i].force, states[i].stiffness,
            states[i].curvature);
}
