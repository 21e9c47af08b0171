/* Compute pendular/bridges. SPDX-License-Identifier: BSD-3-Clause */
#include "compute_bridges.h"

#include <algorithm>

#include "atom.h"
#include "error.h"
#include "force.h"
#include "pair_pendular.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace pendular_lammps {
namespace {
    const char *const WHO = "Compute pendular/bridges";
    const char *const NAMES[]
        = {"id1", "id2", "separation", "force", "volume", "suction", "energy", "rupture_distance"};
}    // namespace

/* compute ID group pendular/bridges NAME ... */
ComputeBridges::ComputeBridges(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
    scalar_flag = vector_flag = local_flag = 1;
    extscalar = extvector = 1;
    size_vector = 3;
    vector = sums;
    for (int k = 3; k < narg; ++k) {
        const auto found = std::find(std::begin(NAMES), std::end(NAMES), std::string(arg[k]));
        if (found == std::end(NAMES))
            error->all(FLERR, "{}: {} is none of id1, id2, separation, force, volume, suction, energy, rupture_distance",
                WHO, arg[k]);
        columns.push_back(static_cast<Column>(found - std::begin(NAMES)));
    }
    if (columns.empty())
        columns = {ID1, ID2};
    size_local_cols = static_cast<int>(columns.size()) > 1 ? static_cast<int>(columns.size()) : 0;
}

void ComputeBridges::init()
{
    pair = dynamic_cast<PairPendular *>(force->pair_match("pendular", 1));
    if (!pair)
        error->all(FLERR, "{}: there is no pair style pendular", WHO);
}

/* Both grains have to be of the group. */
bool ComputeBridges::counts(int number) const
{
    const Ends &ends = pair->bridges.ends[number];
    return atom->mask[ends.i] & atom->mask[ends.j] & groupbit;
}

double ComputeBridges::value(int number, Column column) const
{
    const Ends &ends = pair->bridges.ends[number];
    const Origin &of = pair->bridges.origin[number];
    const Law &law = *of.law;
    const Solids solids = pair->solids_of(law, ends.i, ends.j);
    const double separation = pair->separation_of(ends);
    switch (column) {
    case ID1:
        return static_cast<double>(std::min(of.tag1, of.tag2));
    case ID2:
        return static_cast<double>(std::max(of.tag1, of.tag2));
    case SEPARATION:
        return separation;
    case FORCE:
        return law.force(of.held, solids, separation);
    case VOLUME:
        return law.volume(of.held, solids, separation);
    case SUCTION:
        return law.suction(of.held, solids, separation);
    case ENERGY:
        return law.energy(of.held, solids, separation);
    case RUPTURE:
        return law.rupture(of.held, solids);
    }
    return NAN;
}

double ComputeBridges::compute_scalar()
{
    compute_vector();
    return scalar = sums[0];
}

/* Number, volume of liquid, energy. */
void ComputeBridges::compute_vector()
{
    invoked_vector = invoked_scalar = update->ntimestep;
    std::fill(sums, sums + 3, 0.0);
    for (int k = 0; k < pair->bridges.count(); ++k)
        if (counts(k)) {
            sums[0] += 1.0;
            sums[1] += value(k, VOLUME);
            sums[2] += value(k, ENERGY);
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world);
}

void ComputeBridges::compute_local()
{
    invoked_local = update->ntimestep;
    values.clear();
    for (int k = 0; k < pair->bridges.count(); ++k)
        if (counts(k))
            for (Column column : columns)
                values.push_back(value(k, column));
    const size_t width = columns.size();
    size_local_rows = static_cast<int>(values.size() / width);
    rows.resize(size_local_rows);
    for (int k = 0; k < size_local_rows; ++k)
        rows[k] = values.data() + k * width;
    vector_local = values.data();
    array_local = rows.data();
}

double ComputeBridges::memory_usage()
{
    return static_cast<double>(values.capacity()) * sizeof(double) + static_cast<double>(rows.capacity()) * sizeof(double *);
}

}    // namespace pendular_lammps
