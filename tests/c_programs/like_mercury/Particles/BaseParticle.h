#ifndef LIKE_MERCURY_PARTICLE_H
#define LIKE_MERCURY_PARTICLE_H
#include "Interactions/BaseInteraction.h"
struct BaseParticle : BaseInteractable {
    explicit BaseParticle(Mdouble size) : radius(size) {}
    Mdouble getRadius() const { return radius; }
    Mdouble radius;
};
struct BaseWall : BaseInteractable {};
#endif
