/* Liquid on the grains. SPDX-License-Identifier: BSD-3-Clause */
#include "film.h"

namespace pendular_lammps {

void Film::clear(int atoms)
{
    for (std::vector<double> *numbers : {&returned, &forming, &standing, &offered, &gained, &taken})
        numbers->assign(atoms, 0.0);
}

int Film::numbers() const
{
    return talk == RETURNED ? 3 : talk == TAKEN ? 1 : 2;
}

int Film::pack(int i, double *buffer) const
{
    switch (talk) {
    case RETURNED:
        buffer[0] = returned[i], buffer[1] = forming[i], buffer[2] = standing[i];
        break;
    case OFFERED:
        buffer[0] = offered[i], buffer[1] = gained[i];
        break;
    case TAKEN:
        buffer[0] = taken[i];
        break;
    case FOUND:
        buffer[0] = returned[i], buffer[1] = standing[i];
        break;
    }
    return numbers();
}

int Film::add(int i, const double *buffer)
{
    if (talk == TAKEN)
        taken[i] += buffer[0];
    else {
        returned[i] += buffer[0];
        if (talk == RETURNED)
            forming[i] += buffer[1];
        standing[i] += buffer[numbers() - 1];
    }
    return numbers();
}

int Film::take(int i, const double *buffer)
{
    offered[i] = buffer[0];
    gained[i] = buffer[1];
    return numbers();
}

void Film::offer(int i, double &on_grain)
{
    if (feeds_bridges && standing[i] > 0.0)
        gained[i] = returned[i] / standing[i];
    else
        on_grain += returned[i];
    if (forming[i] > 0.0 && on_grain > 0.0)
        offered[i] = share * on_grain / forming[i];
}

}    // namespace pendular_lammps
