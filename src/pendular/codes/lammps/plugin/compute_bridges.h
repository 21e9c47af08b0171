/* Compute pendular/bridges: all bridges between grains as rows, their number, liquid and energy.
   SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_COMPUTE_BRIDGES_H
#define PENDULAR_LAMMPS_COMPUTE_BRIDGES_H

#include <vector>

#include "compute.h"

namespace pendular_lammps {

class PairPendular;

class ComputeBridges : public LAMMPS_NS::Compute {
public:
    ComputeBridges(LAMMPS_NS::LAMMPS *, int, char **);

    void init() override;
    double compute_scalar() override;
    void compute_vector() override;
    void compute_local() override;
    double memory_usage() override;

private:
    enum Column { ID1, ID2, SEPARATION, FORCE, VOLUME, SUCTION, ENERGY, RUPTURE };

    std::vector<Column> columns;
    std::vector<double> values;
    std::vector<double *> rows;
    double sums[3];
    PairPendular *pair = nullptr;

    bool counts(int number) const;
    double value(int number, Column) const;
};

}    // namespace pendular_lammps

#endif
