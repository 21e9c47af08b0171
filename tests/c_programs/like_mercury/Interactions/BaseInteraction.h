#ifndef LIKE_MERCURY_INTERACTION_H
#define LIKE_MERCURY_INTERACTION_H
#include <istream>
#include <ostream>
typedef double Mdouble;
struct BaseSpecies;
struct Vec3D { Mdouble z; };
inline Vec3D operator*(Vec3D a, Mdouble b) { return { a.z * b }; }
struct BaseInteractable { virtual ~BaseInteractable() {} };

class BaseInteraction
{
public:
    BaseInteraction() : P_(nullptr), I_(nullptr) {}
    BaseInteraction(BaseInteractable *P, BaseInteractable *I, unsigned) : P_(P), I_(I) {}
    virtual ~BaseInteraction() {}
    virtual void write(std::ostream &) const {}
    virtual void read(std::istream &) {}
    virtual Mdouble getElasticEnergy() const { return 0.0; }
    Mdouble getOverlap() const { return overlap; }
    Vec3D getNormal() const { return { 1.0 }; }
    void addForce(Vec3D added) { force += added.z; }
    const BaseInteractable *getP() const { return P_; }
    const BaseInteractable *getI() const { return I_; }
    const BaseSpecies *getBaseSpecies() const { return species; }

    Mdouble overlap = 0.0, force = 0.0;
    const BaseSpecies *species = nullptr;

private:
    BaseInteractable *P_, *I_;
};
#endif
