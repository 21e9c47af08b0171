/* What the example for MUSEN uses, by the names of MUSEN. */
#ifndef LIKE_MUSEN_MODEL_H
#define LIKE_MUSEN_MODEL_H
#include <cmath>
#include <string>
#include <vector>

struct CVector3 {
    double x, y, z;
    void Init(double value) { x = y = z = value; }
    double Length() const { return std::sqrt(x * x + y * y + z * z); }
    CVector3 operator-(const CVector3 &o) const { return { x - o.x, y - o.y, z - o.z }; }
    CVector3 operator*(double k) const { return { x * k, y * k, z * k }; }
    CVector3 &operator+=(const CVector3 &o) { return *this = { x + o.x, y + o.y, z + o.z }; }
    CVector3 &operator-=(const CVector3 &o) { return *this = { x - o.x, y - o.y, z - o.z }; }
};

struct SParticleStruct {
    std::vector<double> radii;
    std::vector<CVector3> places, forces;
    double Radius(size_t i) const { return radii[i]; }
    const CVector3 &Coord(size_t i) const { return places[i]; }
    CVector3 &Force(size_t i) { return forces[i]; }
};

struct SLiquidBondStruct {
    double volume, tension, end;
    bool active;
    CVector3 normal, tangential, moment;
    double Volume(size_t) const { return volume; }
    double SurfaceTension(size_t) const { return tension; }
    bool &Active(size_t) { return active; }
    double &EndActivity(size_t) { return end; }
    CVector3 &NormalForce(size_t) { return normal; }
    const CVector3 &NormalForce(size_t) const { return normal; }
    CVector3 &TangentialForce(size_t) { return tangential; }
    CVector3 &UnsymMoment(size_t) { return moment; }
    size_t LeftID(size_t) const { return 0; }
    size_t RightID(size_t) const { return 1; }
};

class CLiquidBondModel
{
public:
    SParticleStruct *particles;
    SLiquidBondStruct *bonds;
    virtual ~CLiquidBondModel() {}
    virtual void CalculateLB(double, double, size_t, size_t, size_t, SLiquidBondStruct &, unsigned *) const = 0;
    virtual void ConsolidatePart(double, double, size_t, SParticleStruct &) const {}

protected:
    std::string m_name, m_uniqueKey;
    const SParticleStruct &Particles() const { return *particles; }
    const SLiquidBondStruct &Bonds() const { return *bonds; }
};

#endif
