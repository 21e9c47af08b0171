/* Pair style pendular: what the input says, and lists. SPDX-License-Identifier: BSD-3-Clause */
#include "pair_pendular.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "utils.h"

using namespace LAMMPS_NS;

namespace pendular_lammps {
namespace {
    const char *const WHO = "Pair pendular";
    constexpr double ROUNDING = 1.0 + 1e-12;
    constexpr int TOGETHER = 32; /* atoms */
}    // namespace

PairPendular::PairPendular(LAMMPS *lmp) : Pair(lmp)
{
    restartinfo = 0;
    single_enable = 0;
    no_virial_fdotr_compute = 1;
    comm_forward = 2;
    comm_reverse = comm_reverse_off = 10;
    if (modify->get_fix_by_id(FixBridges::NAME))
        error->all(FLERR, "{}: is there already, and one is enough for all types", WHO);
    history = dynamic_cast<FixBridges *>(modify->add_fix(fmt::format("{} all pendular/bridges", FixBridges::NAME)));
    history->pair = this;
}

PairPendular::~PairPendular()
{
    if (copymode)
        return;
    if (history) {
        history->pair = nullptr;
        modify->delete_fix(FixBridges::NAME);
    }
    if (allocated) {
        memory->destroy(setflag);
        memory->destroy(cutsq);
    }
}

void PairPendular::allocate()
{
    const int size = atom->ntypes + 1;
    memory->create(setflag, size, size, "pair:setflag");
    memory->create(cutsq, size, size, "pair:cutsq");
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j)
            setflag[i][j] = 0;
    law_of.assign(size, std::vector<Law *>(size, nullptr));
    largest.assign(size, 0.0);
    allocated = 1;
}

/* film NAME, share S, rupture film | bridges */
void PairPendular::settings(int narg, char **arg)
{
    film = Film();
    for (int i = 0; i < narg; i += 2) {
        const std::string word = arg[i];
        if (i + 1 >= narg)
            error->all(FLERR, "{}: a value is missing after {}", WHO, word);
        if (word == "film")
            film.name = arg[i + 1];
        else if (word == "share") {
            film.share = utils::numeric(FLERR, arg[i + 1], false, lmp);
            if (!(film.share > 0.0 && film.share <= 1.0))
                error->all(FLERR, "{}: share {} is not in (0, 1]", WHO, arg[i + 1]);
        } else if (word == "rupture") {
            const std::string rule = arg[i + 1];
            if (rule != "film" && rule != "bridges")
                error->all(FLERR, "{}: rupture {} is neither film nor bridges", WHO, rule);
            film.feeds_bridges = rule == "bridges";
        } else
            error->all(FLERR, "{}: {} is none of film, share, rupture", WHO, word);
    }
    if (narg > 0 && !film.is_there())
        error->all(FLERR, "{}: share and rupture go with film, the name of a fix property/atom d_NAME", WHO);
}

void PairPendular::coeff(int narg, char **arg)
{
    if (narg < 3)
        error->all(FLERR, "{}: pair_coeff wants two types, a table or 'exact', and what is held", WHO);
    if (!allocated)
        allocate();
    int first[2], last[2];
    for (int k = 0; k < 2; ++k)
        utils::bounds(FLERR, arg[k], 1, atom->ntypes, first[k], last[k], error);
    auto law = std::make_shared<Law>(lmp, WHO);
    const int read = 2 + law->read(narg - 2, arg + 2);
    if (read < narg)
        error->all(FLERR, "{}: pair_coeff does not know {}", WHO, arg[read]);
    int set = 0;
    for (int i = first[0]; i <= last[0]; ++i)
        for (int j = std::max(first[1], i); j <= last[1]; ++j) {
            if (i == j && law->is_of_two_angles())
                error->all(FLERR, "{}: two contact angles go with two types, and {} {} is one", WHO, i, j);
            law_of[i][j] = law_of[j][i] = law.get();
            setflag[i][j] = 1;
            ++set;
        }
    if (set == 0)
        error->all(FLERR, "{}: pair_coeff {} {} names no pair of types; give the lower one first", WHO, arg[0], arg[1]);
    laws.push_back(law);
    retire_laws();
}

/* Laws that another one has replaced stay, for there may be bridges yet that were made by them. */
void PairPendular::retire_laws()
{
    std::vector<std::shared_ptr<Law>> in_use;
    for (const std::shared_ptr<Law> &law : laws) {
        bool is_used = false;
        for (const std::vector<Law *> &row : law_of)
            is_used = is_used || std::find(row.begin(), row.end(), law.get()) != row.end();
        (is_used ? in_use : retired).push_back(law);
    }
    laws.swap(in_use);
}

void PairPendular::init_style()
{
    if (!atom->radius_flag)
        error->all(FLERR, "{}: atoms have no radius; use 'atom_style sphere'", WHO);
    if (!atom->tag_enable)
        error->all(FLERR, "{}: atoms have no ids; leave out 'atom_modify id no'", WHO);
    if (!history)
        error->all(FLERR, "{}: its fix {} was deleted", WHO, FixBridges::NAME);
    check_units(lmp, WHO);
    if (film.is_there()) {
        int is_double, columns;
        if (atom->find_custom(film.name.c_str(), is_double, columns) < 0 || is_double != 1 || columns != 0)
            error->all(FLERR, "{}: film {} is not there; make it by 'fix ID all property/atom d_{}'", WHO, film.name,
                film.name);
    }
    for (const std::shared_ptr<Law> &law : laws) {
        law->refresh();
        if (law->is_viscous() && !comm->ghost_velocity)
            error->all(FLERR, "{}: viscosity needs 'comm_modify vel yes'", WHO);
    }
    find_largest();
    radii_change = false;
    for (const Fix *fix : modify->get_fix_list())
        radii_change = radii_change || fix->diam_flag;
    if (atom->map_style == Atom::MAP_NONE) {
        atom->map_user = Atom::MAP_YES;
        atom->map_init();
    }
    lender = list_lender();
    if (!lender)
        neighbor->add_request(this, NeighConst::REQ_NEWTON_ON | (forms_apart() ? 0 : NeighConst::REQ_SIZE));
}

bool PairPendular::forms_apart() const
{
    return std::any_of(
        laws.begin(), laws.end(), [](const std::shared_ptr<Law> &law) { return law->formation > 0.0; });
}

/* A style for grains, whose list has all pairs that may touch before the next list. */
Pair *PairPendular::list_lender() const
{
    Pair *style = force->newton_pair && !forms_apart() ? force->pair_match("^gran", 0) : nullptr;
    if (!style || !style->setflag || utils::strmatch(force->pair_match_ptr(style), "/kk"))
        return nullptr;
    for (int i = 1; i <= atom->ntypes; ++i)
        for (int j = i; j <= atom->ntypes; ++j)
            if (!style->setflag[i][j])
                return nullptr;
    return style;
}

/* Of the atoms that there are, and of those that fixes will make. */
void PairPendular::find_largest()
{
    std::fill(largest.begin(), largest.end(), 0.0);
    for (int i = 0; i < atom->nlocal; ++i)
        largest[atom->type[i]] = std::max(largest[atom->type[i]], atom->radius[i]);
    for (Fix *fix : modify->get_fix_list())
        if (utils::strmatch(fix->style, "^pour") || utils::strmatch(fix->style, "^deposit"))
            for (int type = 1; type <= atom->ntypes; ++type) {
                int asked = type;
                if (const void *radius = fix->extract("radius", asked))
                    largest[type] = std::max(largest[type], *static_cast<const double *>(radius));
            }
    MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_DOUBLE, MPI_MAX, world);
}

double PairPendular::init_one(int i, int j)
{
    const Law *law = law_of[i][j];
    if (!law)
        error->all(FLERR, "{}: pair_coeff {} {} is missing", WHO, i, j);
    if (largest[i] == 0.0 || largest[j] == 0.0)
        return 0.0;
    return largest[i] + largest[j] + law->range({largest[i], largest[j]});
}

Solids PairPendular::solids_of(const Law &law, int i, int j) const
{
    const double *radius = atom->radius;
    const int *type = atom->type;
    return law.is_of_two_angles() && type[i] > type[j] ? Solids{radius[j], radius[i]} : Solids{radius[i], radius[j]};
}

double PairPendular::separation_of(const Ends &pair) const
{
    double **x = atom->x;
    const double dx = x[pair.j][0] - x[pair.i][0], dy = x[pair.j][1] - x[pair.i][1], dz = x[pair.j][2] - x[pair.i][2];
    return std::sqrt(dx * dx + dy * dy + dz * dz) - (atom->radius[pair.i] + atom->radius[pair.j]);
}

/* Grains that have grown would come near enough for a bridge before they are in the list. */
void PairPendular::check_radii() const
{
    for (int i = 0; i < atom->nlocal; ++i)
        if (atom->radius[i] > largest[atom->type[i]] * ROUNDING)
            error->one(FLERR, "{}: atom {} of radius {:.6g} is larger than all of its type {} were when the run began",
                WHO, atom->tag[i], atom->radius[i], atom->type[i]);
}

/* Two atoms with two bridges, through two of their images, could not be told apart. */
void PairPendular::check_box() const
{
    const double *h = domain->h;
    const double x = h[0], y = h[1], z = h[2], yz = h[3], xz = h[4], xy = h[5];
    const double slant = xy * yz - y * xz;
    const double face = std::sqrt(y * y * z * z + xy * xy * z * z + slant * slant);
    const double widths[3] = {x * y * z / face, y * z / std::sqrt(z * z + yz * yz), z};
    for (int k = 0; k < domain->dimension; ++k)
        if (domain->periodicity[k] && widths[k] < 2.0 * cutforce)
            error->all(FLERR, "{}: the width {:.6g} of the box along {} is less than twice {:.6g}, how far bridges reach",
                WHO, widths[k], "xyz"[k], cutforce);
}

void PairPendular::take_list()
{
    cutforce = 0.0;
    for (int i = 1; i <= atom->ntypes; ++i)
        for (int j = i; j <= atom->ntypes; ++j)
            cutforce = std::max(cutforce, std::sqrt(cutsq[i][j]));
    check_radii();
    check_box();
    std::swap(former, bridges);
    bridges.clear();
    bridges.reserve(former.count());
    watched.clear();
    if (film.is_there())
        film.clear(atom->nlocal + atom->nghost);
    find_bridges();
    const NeighList &near = lender ? *lender->list : *list;
    for (int row = 0; row < near.inum; ++row)
        find_watched(near, near.ilist[row]);
    bridges.append(apart);
    if (film.is_there())
        return_lost();
}

/* The rank that has the grain of the lower id has the bridge. Some atoms at a time, so that what is known of their partners
   is on its way from memory while others are looked for. */
void PairPendular::find_bridges()
{
    const double *x = atom->x[0];
    std::vector<Kept> kept;
    for (int first = 0; first < atom->nlocal; first += TOGETHER) {
        kept.clear();
        for (int i = first; i < std::min(first + TOGETHER, atom->nlocal); ++i) {
            const tagint own = atom->tag[i];
            for (const Partner *partner = history->begin(i); partner != history->end(i); ++partner) {
                if (partner->tag < own)
                    continue;
                const int j = place_of(*partner);
                if (j < 0)
                    continue;
                fetch(x + 3L * j);
                fetch(atom->radius + j);
                fetch(atom->type + j);
                kept.push_back({i, j, partner});
            }
        }
        for (const Kept &bridge : kept)
            take_over(bridge);
    }
}

/* Of an image of a grain, -1 if there is none here: most are where they were. */
int PairPendular::place_of(const Partner &partner) const
{
    if (partner.former >= 0) {
        const int before = former.ends[partner.former].j;
        if (before < atom->nlocal && atom->tag[before] == partner.tag)
            return before;
    }
    return partner.tag > atom->map_tag_max ? -1 : atom->map(partner.tag);
}

double PairPendular::square_of_distance(int i, int j) const
{
    const double *one = atom->x[0] + 3L * i, *other = atom->x[0] + 3L * j;
    const double dx = other[0] - one[0], dy = other[1] - one[1], dz = other[2] - one[2];
    return dx * dx + dy * dy + dz * dz;
}

/* The pairs of an atom that may form a bridge before the next list. */
void PairPendular::find_watched(const NeighList &near, int i)
{
    const double *radius = atom->radius;
    const tagint *tags = atom->tag;
    const Partner *begin = history->begin(i), *end = history->end(i);
    const int *row = near.firstneigh[i], count = near.numneigh[i];
    for (int k = 0; k < count; ++k) {
        const int j = row[k] & NEIGHMASK;
        const tagint tag = tags[j];
        if (std::any_of(begin, end, [tag](const Partner &partner) { return partner.tag == tag; }))
            continue;
        const double reach
            = radius[i] + radius[j] + law_of[atom->type[i]][atom->type[j]]->formation + neighbor->skin;
        if (!(square_of_distance(i, j) > reach * reach))
            watch(i, j);
    }
}

/* A bridge of the list before, which this rank may have known. Those of grains apart stand behind all others, where the
   processor foresees which they are. */
void PairPendular::take_over(const Kept &bridge)
{
    const Partner &partner = *bridge.partner;
    const int i = bridge.i, before = partner.former;
    int j = bridge.j;
    double square = square_of_distance(i, j);
    if (square > cutforce * cutforce) { /* nearer than half of the box there is no other image */
        j = domain->closest_image(i, j);
        square = square_of_distance(i, j);
    }
    Law &law = *law_of[atom->type[i]][atom->type[j]];
    const double sum = atom->radius[i] + atom->radius[j];
    const double held = law.is_drained() ? law.control() : std::fabs(partner.held);
    if (film.is_there())
        for (int end : {i, j}) {
            film.returned[end] += std::fmax(partner.held, 0.0);
            film.standing[end] += 1.0;
        }
    const bool is_apart = square > sum * sum;
    Bridges &set = is_apart ? apart : bridges;
    const int number = set.count();
    set.add({i, j, NAN, NAN}, {atom->tag[i], partner.tag, &law, held});
    if (before < 0)
        return;
    const Origin &of = former.origin[before];
    if (of.law != &law || of.held != held || former.ends[before].sum != sum)
        return;
    set.ends[number].sum = sum;
    set.ends[number].touching = former.ends[before].touching;
    if (is_apart && former.record[before] >= 0)
        set.record_of(number) = std::move(former.records[former.record[before]]);
}

}    // namespace pendular_lammps
