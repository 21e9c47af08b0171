#ifndef LIKE_MERCURY_ADHESIVE_H
#define LIKE_MERCURY_ADHESIVE_H
#include "Species/BaseSpecies.h"
class BaseAdhesiveForce
{
public:
    virtual ~BaseAdhesiveForce() {}
    virtual void setInteractionDistance() {}
    BaseSpecies *getBaseSpecies() { return base; }
    BaseSpecies *base = nullptr;
};
#endif
