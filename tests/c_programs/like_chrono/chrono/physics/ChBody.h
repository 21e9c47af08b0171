/* What the example for Chrono uses, by the names of Chrono. */
#ifndef LIKE_CHRONO_BODY_H
#define LIKE_CHRONO_BODY_H
#include <cmath>
#include <vector>

namespace chrono
{

struct ChVector3d {
    double x, y, z;
    double Length() const { return std::sqrt(x * x + y * y + z * z); }
    ChVector3d operator-() const { return { -x, -y, -z }; }
    ChVector3d operator-(const ChVector3d &o) const { return { x - o.x, y - o.y, z - o.z }; }
    ChVector3d operator+(const ChVector3d &o) const { return { x + o.x, y + o.y, z + o.z }; }
    ChVector3d operator*(double k) const { return { x * k, y * k, z * k }; }
};

struct ChBody {
    ChVector3d place;
    std::vector<ChVector3d> forces;
    const ChVector3d &GetPos() const { return place; }
    unsigned AddAccumulator()
    {
        forces.push_back({ 0, 0, 0 });
        return static_cast<unsigned>(forces.size()) - 1;
    }
    void EmptyAccumulator(unsigned i) { forces[i] = { 0, 0, 0 }; }
    void AccumulateForce(unsigned i, const ChVector3d &force, const ChVector3d &, bool) { forces[i] = forces[i] + force; }
};

}

#endif
