#ifndef LIKE_MERCURY_SPECIES_H
#define LIKE_MERCURY_SPECIES_H
#include "Interactions/BaseInteraction.h"
class BaseAdhesiveForce;
struct BaseSpecies {
    const BaseAdhesiveForce *getAdhesiveForce() const { return adhesive; }
    void setInteractionDistance(Mdouble length) { distance = length; }
    const BaseAdhesiveForce *adhesive = nullptr;
    Mdouble distance = 0.0;
};
#endif
