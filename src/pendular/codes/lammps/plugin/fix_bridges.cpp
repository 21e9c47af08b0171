/* Which grains have a bridge, kept with the grains. SPDX-License-Identifier: BSD-3-Clause */
#include "fix_bridges.h"

#include <cstring>
#include <numeric>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
#include "pair_pendular.h"

using namespace LAMMPS_NS;
using namespace FixConst;

namespace pendular_lammps {
namespace {
    constexpr int PARTNER = 2; /* numbers of a partner in a buffer */
    constexpr int AHEAD = 32;  /* bridges */
}

FixBridges::FixBridges(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
    if (narg != 3 || std::strcmp(id, NAME) != 0)
        error->all(FLERR, "Fix pendular/bridges: is made by pair style pendular alone");
    restart_peratom = 1;
    restart_global = 1; /* so that write_restart is called before the atoms are packed */
    create_attribute = 1;
    maxexchange_dynamic = 1;
    comm_reverse = 1;
    FixBridges::grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
}

FixBridges::~FixBridges()
{
    if (copymode)
        return;
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
    if (pair)
        pair->forget_history();
}

int FixBridges::setmask()
{
    return PRE_EXCHANGE | MIN_PRE_EXCHANGE | POST_NEIGHBOR | MIN_POST_NEIGHBOR;
}

void FixBridges::init()
{
    for (const Fix *fix : modify->get_fix_list()) {
        if (fix == this)
            break;
        if (fix->pre_exchange_migrate)
            error->all(FLERR, "Pair pendular: fix {} moves atoms from rank to rank; define it after pair_style", fix->id);
    }
}

/* From the list of the pair style to the atoms. Either atom of a bridge will have it, for the next list may begin at
   either; those of ghosts are sent to where the atoms are. */
void FixBridges::pre_exchange()
{
    if (!is_behind || !pair)
        return;
    is_behind = false;
    std::fill(rows.begin(), rows.end(), Row());
    for (const Ends &ends : pair->bridges.ends) {
        ++rows[ends.i].count;
        ++rows[ends.j].count;
    }
    counts_only = true;
    comm->reverse_comm(this, 1);
    fill();
    counts_only = false;
    comm->reverse_comm_variable(this);
    for (size_t i = local; i < rows.size(); ++i) /* ghosts, and atoms that were added since */
        rows[i].count = 0;
    follow_moves();
    most = 0;
    for (int i = 0; i < atom->nlocal; ++i) {
        most = std::max(most, rows[i].count);
        known_as[i] = atom->tag[i];
    }
    maxexchange = PARTNER * most + 2;
}

/* A fix before this one may have deleted atoms, and put others in their places. The ranks talked of the atoms where they
   were when the list was built. */
void FixBridges::follow_moves()
{
    if (moves.empty())
        return;
    std::vector<int> former(rows.size());
    std::iota(former.begin(), former.end(), 0);
    for (const auto &[from, to] : moves)
        former[to] = from < 0 ? -1 : former[from];
    moves.clear();
    const std::vector<Row> before = rows;
    std::fill(rows.begin(), rows.end(), Row());
    for (int i = 0; i < atom->nlocal; ++i)
        if (former[i] >= 0)
            rows[i] = before[former[i]];
}

/* The same with the liquid in the bridges, so that what was drained may go on undrained, with the liquid that it has. */
void FixBridges::keep_volumes()
{
    volumes_wanted = true;
    pre_exchange();
    volumes_wanted = false;
}

/* Room for as many partners as were counted, and those that this rank knows. */
void FixBridges::fill()
{
    int size = 0;
    for (int i = 0; i < all; ++i) {
        const int count = rows[i].count;
        rows[i] = {size, 0};
        size += count;
    }
    pool.resize(size);
    const int last = pair->bridges.count() - 1;
    for (int k = 0; k <= last; ++k) {
        const Ends &ends = pair->bridges.ends[k];
        fetch(&rows[pair->bridges.ends[std::min(k + 2 * AHEAD, last)].j]);
        fetch(&pool[rows[pair->bridges.ends[std::min(k + AHEAD, last)].j].first]);
        const Origin &of = pair->bridges.origin[k];
        const double held = !of.law->is_drained() ? of.held : volumes_wanted ? -pair->volume_of(k) : 0.0;
        add(ends.i, {of.tag2, k, held});
        add(ends.j, {of.tag1, k, held});
    }
}

void FixBridges::add(int i, const Partner &partner)
{
    Row &row = rows[i];
    pool[row.first + row.count++] = partner;
}

void FixBridges::post_neighbor()
{
    local = atom->nlocal;
    all = local + atom->nghost;
    for (int i = 0; i < local; ++i)
        if (rows[i].count && known_as[i] != atom->tag[i])
            error->one(FLERR, "Pair pendular: atom {} with a bridge became atom {}; use 'delete_atoms ... compress no'",
                known_as[i], atom->tag[i]);
    if (pair)
        pair->take_list();
}

void FixBridges::grow_arrays(int most_atoms)
{
    rows.resize(most_atoms);
    known_as.resize(most_atoms, 0);
}

void FixBridges::copy_arrays(int i, int j, int)
{
    if (is_behind)
        moves.emplace_back(i, j);
    rows[j] = rows[i];
    known_as[j] = known_as[i];
}

void FixBridges::set_arrays(int i)
{
    if (is_behind)
        moves.emplace_back(-1, i);
    rows[i].count = 0;
}

int FixBridges::pack_reverse_comm_size(int n, int first)
{
    int size = 0;
    for (int i = first; i < first + n; ++i)
        size += 1 + PARTNER * rows[i].count;
    return size;
}

int FixBridges::pack_reverse_comm(int n, int first, double *buffer)
{
    int size = 0;
    for (int i = first; i < first + n; ++i) {
        if (counts_only)
            buffer[size++] = rows[i].count;
        else
            size += pack(i, buffer + size);
    }
    return size;
}

void FixBridges::unpack_reverse_comm(int n, int *list, double *buffer)
{
    int size = 0;
    for (int k = 0; k < n; ++k) {
        const int i = list[k], sent = static_cast<int>(buffer[size++]);
        if (counts_only) {
            rows[i].count += sent;
            continue;
        }
        for (int m = 0; m < sent; ++m, size += PARTNER)
            add(i, {static_cast<tagint>(ubuf(buffer[size]).i), -1, buffer[size + 1]});
    }
}

int FixBridges::pack(int i, double *buffer) const
{
    int size = 0;
    buffer[size++] = rows[i].count;
    for (const Partner *partner = begin(i); partner != end(i); ++partner) {
        buffer[size++] = ubuf(static_cast<int64_t>(partner->tag)).d;
        buffer[size++] = partner->held;
    }
    return size;
}

int FixBridges::unpack(int i, const double *buffer)
{
    const int sent = static_cast<int>(buffer[1]);
    known_as[i] = static_cast<tagint>(ubuf(buffer[0]).i);
    rows[i] = {static_cast<int>(pool.size()), sent};
    most = std::max(most, sent);
    maxexchange = std::max(maxexchange, PARTNER * sent + 2);
    for (int m = 0; m < sent; ++m) {
        const double *partner = buffer + 2 + PARTNER * m;
        pool.push_back({static_cast<tagint>(ubuf(partner[0]).i), -1, partner[1]});
    }
    return 2 + PARTNER * sent;
}

int FixBridges::pack_exchange(int i, double *buffer)
{
    buffer[0] = ubuf(static_cast<int64_t>(known_as[i])).d;
    return 1 + pack(i, buffer + 1);
}

int FixBridges::unpack_exchange(int i, double *buffer)
{
    return unpack(i, buffer);
}

void FixBridges::write_restart(FILE *file)
{
    keep_volumes();
    if (comm->me == 0) {
        const int size = 0;
        fwrite(&size, sizeof size, 1, file);
    }
}

int FixBridges::pack_restart(int i, double *buffer)
{
    const int size = 1 + pack_exchange(i, buffer + 1);
    buffer[0] = size;
    return size;
}

void FixBridges::unpack_restart(int i, int nth)
{
    const double *extra = atom->extra[i];
    for (int k = 0; k < nth; ++k)
        extra += static_cast<int>(extra[0]);
    unpack(i, extra + 1);
}

int FixBridges::size_restart(int i)
{
    return 3 + PARTNER * rows[i].count;
}

int FixBridges::maxsize_restart()
{
    int largest;
    MPI_Allreduce(&most, &largest, 1, MPI_INT, MPI_MAX, world);
    return 3 + PARTNER * largest;
}

double FixBridges::memory_usage()
{
    return static_cast<double>(pool.capacity()) * sizeof(Partner)
        + static_cast<double>(rows.capacity()) * (sizeof(Row) + sizeof(tagint));
}

}    // namespace pendular_lammps
