/* Bridges of a table as a model of liquid bonds in MUSEN: a class derived from CLiquidBondModel.

   A liquid bond lives in touch and beyond it, until its model breaks it: from the rupture distance on. Its volume, that of
   MUSEN's bond, is held, so the table is one at constant volume (`pendular export table --reduced-volume ...`). The bond
   carries the surface tension too.

   Compiled against MUSEN of November 2025 and linked with its models and scenes; MUSEN itself was not built.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#ifndef PENDULAR_MUSEN_H
#define PENDULAR_MUSEN_H

#include <stdexcept>
#include <string>

#include "AbstractDEMModel.h"

#include "pendular_table.h"

class PendularModel : public CLiquidBondModel
{
public:
    explicit PendularModel(const std::string &path)
    {
        m_name = "Pendular";
        m_uniqueKey = "F0B6C7E2A4D94E1F8B5A3C2D1E0F9A8B";
        const int code = pendular_table_open(path.c_str(), &table_);
        if (code != PENDULAR_TABLE_OK)
            throw std::runtime_error(path + ": " + pendular_table_error(code));
    }

    ~PendularModel() { pendular_table_close(&table_); }

    /* The vector of a bond runs from the right grain to the left one, and its force is that on the left one. */
    void CalculateLB(double time, double, size_t left, size_t right, size_t bond, SLiquidBondStruct &bonds,
        unsigned *broken) const override
    {
        const CVector3 way = Particles().Coord(left) - Particles().Coord(right);
        const double distance = way.Length(), radius1 = Particles().Radius(left), radius2 = Particles().Radius(right);
        const double pull = pendular_table_force(
            &table_, distance - radius1 - radius2, Bonds().Volume(bond), radius1, radius2, Bonds().SurfaceTension(bond));
        if (pull != pull)
            throw std::runtime_error("a liquid bond is out of the range of its table");
        bonds.NormalForce(bond) = way * (-pull / distance);
        bonds.TangentialForce(bond).Init(0);
        bonds.UnsymMoment(bond).Init(0);
        if (pull != 0.0)
            return;
        bonds.Active(bond) = false;
        bonds.EndActivity(bond) = time;
        *broken += 1;
    }

    void ConsolidatePart(double, double, size_t bond, SParticleStruct &particles) const override
    {
        particles.Force(Bonds().LeftID(bond)) += Bonds().NormalForce(bond);
        particles.Force(Bonds().RightID(bond)) -= Bonds().NormalForce(bond);
    }

private:
    pendular_table table_;
};

#endif
