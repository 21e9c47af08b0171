/* Bridges of a table in MercuryDPM: an adhesive force, to be put beside a normal and a friction force.

     typedef Species<LinearViscoelasticNormalSpecies, SlidingFrictionSpecies, PendularSpecies> WetSpecies;

     WetSpecies species;
     species.setTable(&table, suction, surfaceTension);      the table is open, and outlives the species
     species.setRadii(smallest, largest);                    of the grains: how far their bridges reach

   A bridge forms in touch and lives to its rupture distance. Contacts with walls are those with planes.

   Compiled against the headers of MercuryDPM of July 2024; not linked, and not run.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#ifndef PENDULAR_MERCURY_H
#define PENDULAR_MERCURY_H

#include <algorithm>
#include <limits>
#include <string>

#include "Interactions/BaseInteraction.h"
#include "Logger.h"
#include "Particles/BaseParticle.h"
#include "Species/AdhesiveForceSpecies/BaseAdhesiveForce.h"
#include "Species/BaseSpecies.h"

#include "pendular_table.h"

class PendularSpecies;

class PendularInteraction : public virtual BaseInteraction
{
public:
    typedef PendularSpecies SpeciesType;

    PendularInteraction() : hasBridge_(false) {}
    PendularInteraction(BaseInteractable *P, BaseInteractable *I, unsigned timeStamp) :
        BaseInteraction(P, I, timeStamp), hasBridge_(false)
    {}

    void computeAdhesionForce();

    void write(std::ostream &os) const override { os << " hasBridge " << hasBridge_; }

    void read(std::istream &is) override
    {
        std::string word;
        is >> word >> hasBridge_;
    }

    Mdouble getElasticEnergy() const override { return 0.0; }
    const PendularSpecies *getSpecies() const;
    std::string getBaseName() const { return "Pendular"; }

private:
    bool hasBridge_;
};

class PendularSpecies : public BaseAdhesiveForce
{
public:
    typedef PendularInteraction InteractionType;

    PendularSpecies() : table_(nullptr), held_(0.0), surfaceTension_(0.0), smallest_(0.0), largest_(0.0) {}

    /* What is held is the suction or the volume, as the table has it. */
    void setTable(const pendular_table *table, Mdouble held, Mdouble surfaceTension)
    {
        table_ = table;
        held_ = held;
        surfaceTension_ = surfaceTension;
        setInteractionDistance();
    }

    void setRadii(Mdouble smallest, Mdouble largest)
    {
        smallest_ = smallest;
        largest_ = largest;
        setInteractionDistance();
    }

    /* Of equal grains, and of grains with a wall, the largest reach farthest under suction, the smallest at constant
       volume. */
    void setInteractionDistance() override
    {
        if (!table_ || smallest_ <= 0.0)
            return;
        Mdouble farthest = 0.0;
        for (Mdouble radius : { smallest_, largest_ })
            for (Mdouble other : { smallest_, largest_, wall() })
                farthest = std::max(farthest, rupture(radius, other));
        getBaseSpecies()->setInteractionDistance(farthest);
    }

    Mdouble force(Mdouble separation, Mdouble radius1, Mdouble radius2) const
    {
        return pendular_table_force(table_, separation, held_, radius1, radius2, surfaceTension_);
    }

    static Mdouble wall() { return std::numeric_limits<Mdouble>::infinity(); }

    void mix(PendularSpecies *S, PendularSpecies *) { *this = *S; }
    void write(std::ostream &os) const { os << " held " << held_ << " surfaceTension " << surfaceTension_; }

    void read(std::istream &is)
    {
        std::string word;
        is >> word >> held_ >> word >> surfaceTension_;
    }

    std::string getBaseName() const { return "Pendular"; }

private:
    const pendular_table *table_;
    Mdouble held_, surfaceTension_, smallest_, largest_;

    Mdouble rupture(Mdouble radius1, Mdouble radius2) const
    {
        return pendular_table_rupture_distance(table_, held_, radius1, radius2, surfaceTension_);
    }
};

inline const PendularSpecies *PendularInteraction::getSpecies() const
{
    return static_cast<const PendularSpecies *>(getBaseSpecies()->getAdhesiveForce());
}

inline void PendularInteraction::computeAdhesionForce()
{
    const Mdouble separation = -getOverlap();
    if (separation > 0.0 && !hasBridge_)
        return;
    const BaseParticle *first = dynamic_cast<const BaseParticle *>(getP());
    const BaseParticle *second = dynamic_cast<const BaseParticle *>(getI());
    const Mdouble attraction = getSpecies()->force(
        separation, first->getRadius(), second ? second->getRadius() : PendularSpecies::wall());
    if (attraction != attraction)
        logger(ERROR, "a bridge is out of the range of its table");
    hasBridge_ = attraction != 0.0;
    addForce(getNormal() * -attraction);
}

#endif
