/* Pair style pendular: a step. SPDX-License-Identifier: BSD-3-Clause */
#include <algorithm>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "pair_pendular.h"

using namespace LAMMPS_NS;

namespace pendular_lammps {
namespace {
    constexpr double ROUNDING = 1.0 + 1e-12;
    constexpr int HOME = 10; /* numbers of a ghost: force, energy, virial */
    constexpr int AHEAD = 32; /* bridges whose second grain is fetched from memory before their turn */
}    // namespace

void PairPendular::compute(int eflag, int vflag)
{
    ev_init(eflag, vflag);
    history->fall_behind();
    refresh();
    clear_ghosts();
    broken.clear();
    forming.clear();
    if (force->newton_pair)
        evflag ? add_forces<true, false>() : add_forces<false, false>();
    else
        evflag ? add_forces<true, true>() : add_forces<false, true>();
    look_at_watched();
    if (film.is_there())
        exchange_film();
    remove_broken();
    add_drags();
    bring_home();
}

/* Suctions that are variables, and radii where a fix may change them. */
void PairPendular::refresh()
{
    if (radii_change) {
        for (Ends &pair : bridges.ends)
            if (pair.sum != atom->radius[pair.i] + atom->radius[pair.j])
                pair.sum = NAN;
        for (Watched &pair : watched)
            pair.near = nearness(pair.i, pair.j);
    }
    for (const std::shared_ptr<Law> &law : laws)
        if (law->refresh() && law->is_drained())
            for (int k = 0; k < bridges.count(); ++k)
                if (bridges.origin[k].law == law.get()) {
                    bridges.origin[k].held = law->control();
                    bridges.renew(k);
                }
}

/* -- Forces --------------------------------------------------------------------------------------------------------- */

template <bool TALLIES, bool KEEPS_GHOSTS> void PairPendular::add_forces()
{
    const int count = bridges.count(), local = atom->nlocal;
    if (count == 0)
        return;
    const Ends *ends = bridges.ends.data();
    const double *x = atom->x[0]; /* rows lie side by side, and a pointer to each takes time */
    double *f = atom->f[0];
    for (int k = 0; k < count; ++k) {
        const Ends &pair = ends[k];
        const long ahead = 3L * ends[std::min(k + AHEAD, count - 1)].j;
        fetch(x + ahead);
        fetch(f + ahead);
        const double *from = x + 3L * pair.i, *to = x + 3L * pair.j;
        const double dx = to[0] - from[0], dy = to[1] - from[1], dz = to[2] - from[2];
        const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
        double pull = pair.touching;
        if (!(distance <= pair.sum)) {
            pull = pull_at(k, distance);
            if (pull == 0.0) {
                broken.push_back(k);
                continue;
            }
        }
        const double part = pull / distance;
        double *one = f + 3L * pair.i;
        double *other = KEEPS_GHOSTS && pair.j >= local ? &on_ghosts[HOME * (pair.j - local)] : f + 3L * pair.j;
        one[0] += dx * part;
        one[1] += dy * part;
        one[2] += dz * part;
        other[0] -= dx * part;
        other[1] -= dy * part;
        other[2] -= dz * part;
        if (TALLIES)
            tally(k, part, dx, dy, dz);
    }
}

/* Attraction of a bridge; 0 from the rupture distance on. */
double PairPendular::pull_at(int number, double distance)
{
    const int record = bridges.record[number];
    const double pull = record < 0 ? NAN : pull_of(bridges.ends[number], bridges.records[record], distance);
    return std::isnan(pull) ? renewed_pull(number, distance) : pull;
}

/* The same of a bridge that has left its cell, or has to be made anew. */
double PairPendular::renewed_pull(int number, double distance)
{
    Ends &pair = bridges.ends[number];
    const Law &law = *bridges.origin[number].law;
    const Solids solids = solids_of(law, pair.i, pair.j);
    if (std::isnan(pair.sum)) {
        pair.sum = solids.radius1 + solids.radius2;
        bridges.drop_record(number);
        if (distance <= pair.sum) {
            Bridge bridge;
            make(number, bridge, solids);
        }
    }
    if (distance <= pair.sum)
        return pair.touching;
    if (bridges.record[number] < 0)
        make(number, bridges.record_of(number), solids);
    const double pull = law.pull(bridges.record_of(number), solids, pair.touching, distance - pair.sum);
    if (std::isnan(pull))
        refuse(pair.i, pair.j, law.refusal(bridges.origin[number].held, solids));
    return pull;
}

/* What is known of a bridge before its separation: the attraction at contact, and where it breaks. */
void PairPendular::make(int number, Bridge &bridge, const Solids &solids)
{
    Ends &pair = bridges.ends[number];
    const Origin &of = bridges.origin[number];
    pair.touching = of.law->renew(bridge, of.held, solids);
    if (std::isnan(pair.touching))
        refuse(pair.i, pair.j, of.law->refusal(of.held, solids));
    const double reach = pair.sum + bridge.rupture;
    if (reach * reach > cutsq[atom->type[pair.i]][atom->type[pair.j]] * ROUNDING)
        refuse(pair.i, pair.j,
            fmt::format("their bridge reaches {:.6g} between the surfaces, farther than bridges are looked for; give "
                        "'reach' in pair_coeff",
                bridge.rupture));
}

/* Forces by the viscosity of the liquid, where a law has it. */
void PairPendular::add_drags()
{
    bool is_any = false;
    for (const std::shared_ptr<Law> &law : laws)
        is_any = is_any || law->is_viscous();
    if (!is_any)
        return;
    double **x = atom->x, **v = atom->v;
    for (int k = 0; k < bridges.count(); ++k) {
        const int i = bridges.ends[k].i, j = bridges.ends[k].j;
        const Law &law = *bridges.origin[k].law;
        if (!law.is_viscous())
            continue;
        const double way[3] = {x[j][0] - x[i][0], x[j][1] - x[i][1], x[j][2] - x[i][2]};
        const double distance = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        double speed = 0.0;
        for (int m = 0; m < 3; ++m)
            speed += (v[j][m] - v[i][m]) * way[m] / distance;
        const double separation = distance - (atom->radius[i] + atom->radius[j]);
        const double drag = law.drag(bridges.origin[k].held, solids_of(law, i, j), separation, speed);
        const double part = drag / distance;
        double *other = other_end(j);
        for (int m = 0; m < 3; ++m) {
            atom->f[i][m] += part * way[m];
            other[m] -= part * way[m];
        }
        if (evflag)
            ev_tally(i, j, atom->nlocal, 1, 0.0, 0.0, -part, -way[0], -way[1], -way[2]);
    }
}

/* Where the force on the second atom of a pair is added up. */
double *PairPendular::other_end(int j)
{
    return !force->newton_pair && j >= atom->nlocal ? &on_ghosts[HOME * (j - atom->nlocal)] : atom->f[j];
}

void PairPendular::refuse(int i, int j, const std::string &why) const
{
    error->one(FLERR, "Pair pendular: atoms {} and {}: {}", atom->tag[i], atom->tag[j], why);
}

/* Energy and virial, of which a ghost has its half. */
void PairPendular::tally(int number, double part, double dx, double dy, double dz)
{
    const Ends &pair = bridges.ends[number];
    const Origin &of = bridges.origin[number];
    double energy = 0.0;
    if (eflag_either)
        energy = of.law->energy(of.held, solids_of(*of.law, pair.i, pair.j), separation_of(pair));
    ev_tally(pair.i, pair.j, atom->nlocal, 1, energy, 0.0, -part, -dx, -dy, -dz);
}

/* -- Bridges that form and break ------------------------------------------------------------------------------------ */

double PairPendular::nearness(int i, int j) const
{
    const double near
        = atom->radius[i] + atom->radius[j] + law_of[atom->type[i]][atom->type[j]]->formation;
    return near * near;
}

void PairPendular::watch(int i, int j)
{
    watched.push_back({i, j, nearness(i, j)});
}

void PairPendular::look_at_watched()
{
    const int count = static_cast<int>(watched.size());
    arrived.clear();
    if (count == 0)
        return;
    const double *x = atom->x[0];
    for (int k = 0; k < count; ++k) {
        const Watched &pair = watched[k];
        fetch(x + 3L * watched[std::min(k + AHEAD, count - 1)].j);
        const double *from = x + 3L * pair.i, *to = x + 3L * pair.j;
        const double dx = to[0] - from[0], dy = to[1] - from[1], dz = to[2] - from[2];
        if (!(dx * dx + dy * dy + dz * dz > pair.near))
            arrived.push_back(k);
    }
    for (size_t n = arrived.size(); n-- > 0;) {
        const Watched pair = watched[arrived[n]];
        if (!is_joined(pair.i, pair.j))
            continue;
        watched[arrived[n]] = watched.back();
        watched.pop_back();
    }
}

/* Whether a pair near enough forms a bridge, or asks the film whether it may. */
bool PairPendular::is_joined(int i, int j)
{
    Law &law = *law_of[atom->type[i]][atom->type[j]];
    if (film.is_there() && !law.is_drained()) {
        forming.push_back({i, j, &law});
        return true;
    }
    const double held = held_by(i, j, law, INFINITY);
    if (std::isnan(held))
        return false;
    form(i, j, law, held);
    return true;
}

/* What a bridge would hold that forms now, of what is offered; NaN for no bridge. */
double PairPendular::held_by(int i, int j, Law &law, double offered) const
{
    const double held = law.is_drained() ? law.control() : std::min(law.control(), offered);
    const Solids solids = solids_of(law, i, j);
    const double end = law.rupture(held, solids);
    if (std::isnan(end) && held == law.control())
        refuse(i, j, law.refusal(held, solids));
    return separation_of({i, j, 0.0, 0.0}) < end ? held : NAN; /* too little for the table: none */
}

void PairPendular::form(int i, int j, Law &law, double held)
{
    bridges.add({i, j, NAN, NAN}, {atom->tag[i], atom->tag[j], &law, held});
    add_force(bridges.count() - 1);
}

/* Of one that has just formed. */
void PairPendular::add_force(int number)
{
    double **x = atom->x, **f = atom->f;
    const int i = bridges.ends[number].i, j = bridges.ends[number].j;
    const double dx = x[j][0] - x[i][0], dy = x[j][1] - x[i][1], dz = x[j][2] - x[i][2];
    const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    const double part = renewed_pull(number, distance) / distance;
    double *other = other_end(j);
    const double pull[3] = {dx * part, dy * part, dz * part};
    for (int k = 0; k < 3; ++k) {
        f[i][k] += pull[k];
        other[k] -= pull[k];
    }
    if (evflag)
        tally(number, part, dx, dy, dz);
}

/* They may form again. */
void PairPendular::remove_broken()
{
    for (size_t n = broken.size(); n-- > 0;) {
        const int k = broken[n];
        watch(bridges.ends[k].i, bridges.ends[k].j);
        bridges.remove(k);
    }
}

double PairPendular::volume_of(int number) const
{
    const Origin &of = bridges.origin[number];
    const Ends &pair = bridges.ends[number];
    return of.law->volume(of.held, solids_of(*of.law, pair.i, pair.j), separation_of(pair));
}

/* -- Liquid on the grains ------------------------------------------------------------------------------------------- */

double *PairPendular::film_on_grains() const
{
    int is_double, columns;
    return atom->dvector[atom->find_custom(film.name.c_str(), is_double, columns)];
}

void PairPendular::exchange_film()
{
    int is_anything = !forming.empty();
    for (int k : broken)
        is_anything = is_anything || !bridges.origin[k].law->is_drained();
    MPI_Allreduce(MPI_IN_PLACE, &is_anything, 1, MPI_INT, MPI_MAX, world);
    if (!is_anything)
        return;
    film.clear(atom->nlocal + atom->nghost);
    std::vector<bool> is_broken(bridges.count(), false);
    for (int k : broken)
        is_broken[k] = true;
    for (int k = 0; k < bridges.count(); ++k) {
        const Origin &of = bridges.origin[k];
        if (of.law->is_drained())
            continue;
        for (int i : {bridges.ends[k].i, bridges.ends[k].j}) {
            film.returned[i] += is_broken[k] ? 0.5 * of.held : 0.0;
            film.standing[i] += is_broken[k] ? 0.0 : 1.0;
        }
    }
    for (const Candidate &pair : forming)
        for (int i : {pair.i, pair.j})
            film.forming[i] += 1.0;
    film.talk = Film::RETURNED;
    comm->reverse_comm(this, film.numbers());
    double *on_grains = film_on_grains();
    for (int i = 0; i < atom->nlocal; ++i)
        film.offer(i, on_grains[i]);
    film.talk = Film::OFFERED;
    comm->forward_comm(this, film.numbers());
    for (int k = 0; k < bridges.count(); ++k) {
        const double gained = film.gained[bridges.ends[k].i] + film.gained[bridges.ends[k].j];
        Origin &of = bridges.origin[k];
        if (gained > 0.0 && !is_broken[k] && !of.law->is_drained()) {
            of.held += gained;
            bridges.renew(k);
        }
    }
    form_from_film();
    film.talk = Film::TAKEN;
    comm->reverse_comm(this, film.numbers());
    for (int i = 0; i < atom->nlocal; ++i)
        on_grains[i] -= film.taken[i];
}

/* A new bridge takes from its grains in proportion to what they offer. */
void PairPendular::form_from_film()
{
    for (const Candidate &pair : forming) {
        const double offered[2] = {film.offered[pair.i], film.offered[pair.j]};
        const double sum = offered[0] + offered[1];
        const double held = sum > 0.0 ? held_by(pair.i, pair.j, *pair.law, sum) : NAN;
        if (std::isnan(held)) {
            watch(pair.i, pair.j);
            continue;
        }
        form(pair.i, pair.j, *pair.law, held);
        film.taken[pair.i] += held * (offered[0] / sum);
        film.taken[pair.j] += held * (offered[1] / sum);
    }
}

/* Where one of the two grains is gone, or both were put far apart, each that is left has half of the liquid. What was
   found in the list is in the film's numbers. */
void PairPendular::return_lost()
{
    film.talk = Film::FOUND;
    comm->reverse_comm(this, film.numbers());
    double *on_grains = film_on_grains();
    for (int i = 0; i < atom->nlocal; ++i) {
        if (film.standing[i] == history->end(i) - history->begin(i))
            continue;
        double lost = -film.returned[i];
        for (const Partner *partner = history->begin(i); partner != history->end(i); ++partner)
            lost += std::fmax(partner->held, 0.0);
        on_grains[i] += 0.5 * lost;
    }
}

/* -- Ranks ---------------------------------------------------------------------------------------------------------- */

/* Without Newton's law between ranks, LAMMPS leaves what is added to ghosts where it is. */
void PairPendular::clear_ghosts()
{
    if (force->newton_pair)
        return;
    const int local = atom->nlocal, ghosts = atom->nghost;
    on_ghosts.assign(static_cast<size_t>(HOME) * ghosts, 0.0);
    if (eflag_atom)
        std::fill(eatom + local, eatom + local + ghosts, 0.0);
    if (vflag_atom && ghosts)
        std::fill(vatom[local], vatom[local] + 6 * ghosts, 0.0);
}

void PairPendular::bring_home()
{
    if (force->newton_pair)
        return;
    const int local = atom->nlocal, ghosts = atom->nghost;
    const int size = eflag_atom || vflag_atom ? HOME : 3;
    for (int g = 0; g < ghosts; ++g) {
        double *numbers = &on_ghosts[HOME * g];
        if (eflag_atom)
            numbers[3] = eatom[local + g];
        if (vflag_atom)
            std::copy(vatom[local + g], vatom[local + g] + 6, numbers + 4);
    }
    homeward = size;
    comm->reverse_comm(this, size);
    homeward = 0;
}

int PairPendular::pack_reverse_comm(int n, int first, double *buffer)
{
    double *next = buffer;
    for (int i = first; i < first + n; ++i) {
        if (homeward) {
            const double *numbers = &on_ghosts[HOME * (i - atom->nlocal)];
            next = std::copy(numbers, numbers + homeward, next);
        } else
            next += film.pack(i, next);
    }
    return static_cast<int>(next - buffer);
}

/* An atom that is a ghost itself, where a box is but one rank wide, hands on what it gets. */
void PairPendular::unpack_reverse_comm(int n, int *list, double *buffer)
{
    const double *next = buffer;
    for (int k = 0; k < n; ++k) {
        const int i = list[k];
        if (!homeward) {
            next += film.add(i, next);
            continue;
        }
        if (i >= atom->nlocal) {
            double *numbers = &on_ghosts[HOME * (i - atom->nlocal)];
            for (int m = 0; m < homeward; ++m)
                numbers[m] += next[m];
        } else {
            for (int m = 0; m < 3; ++m)
                atom->f[i][m] += next[m];
            if (eflag_atom)
                eatom[i] += next[3];
            if (vflag_atom)
                for (int m = 0; m < 6; ++m)
                    vatom[i][m] += next[4 + m];
        }
        next += homeward;
    }
}

int PairPendular::pack_forward_comm(int n, int *list, double *buffer, int, int *)
{
    double *next = buffer;
    for (int k = 0; k < n; ++k)
        next += film.pack(list[k], next);
    return static_cast<int>(next - buffer);
}

void PairPendular::unpack_forward_comm(int n, int first, double *buffer)
{
    const double *next = buffer;
    for (int i = first; i < first + n; ++i)
        next += film.take(i, next);
}

double PairPendular::memory_usage()
{
    return Pair::memory_usage() + bridges.bytes() + former.bytes() + apart.bytes()
        + static_cast<double>(watched.capacity()) * sizeof(Watched);
}

}    // namespace pendular_lammps
