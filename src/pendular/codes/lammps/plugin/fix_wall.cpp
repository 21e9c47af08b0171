/* Fix pendular/wall: bridges between grains and walls. SPDX-License-Identifier: BSD-3-Clause */
#include "fix_wall.h"

#include <algorithm>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "input.h"
#include "modify.h"
#include "region.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

using namespace LAMMPS_NS;
using namespace FixConst;

namespace pendular_lammps {
namespace {
    const char *const WHO = "Fix pendular/wall";
    const char *const PLANES[] = {"xplane", "yplane", "zplane"};
    constexpr double PLANE = INFINITY; /* radius */
}    // namespace

void FixWall::refuse(const std::string &what) const
{
    error->all(FLERR, "{}: {}", WHO, what);
}

/* fix ID group pendular/wall LAW film NAME share S  zplane LOW HIGH | region NAME curved plane */
FixWall::FixWall(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), law(lmp, WHO)
{
    restart_peratom = 1;
    create_attribute = 1;
    scalar_flag = vector_flag = extscalar = extvector = 1;
    size_vector = ENERGY;
    global_freq = peratom_freq = 1;
    energy_global_flag = virial_global_flag = virial_peratom_flag = 1;
    peratom_flag = 1;
    size_peratom_cols = 0;
    dynamic_group_allow = 1;
    if (narg < 4)
        refuse("a law and walls are missing");
    int next = 3 + law.read(narg - 3, arg + 3);
    for (; next + 1 < narg && (std::strcmp(arg[next], "film") == 0 || std::strcmp(arg[next], "share") == 0); next += 2) {
        if (std::strcmp(arg[next], "film") == 0) {
            film.name = arg[next + 1];
            continue;
        }
        film.share = utils::numeric(FLERR, arg[next + 1], false, lmp);
        if (!(film.share > 0.0 && film.share <= 1.0))
            refuse(fmt::format("share {} is not in (0, 1]", arg[next + 1]));
    }
    next += read_walls(narg - next, arg + next);
    if (next < narg)
        refuse(fmt::format("does not know {}", arg[next]));
    if (law.is_viscous() && !(place_variable[0].empty() && place_variable[1].empty()))
        refuse("viscosity: the speed of a wall whose place is a variable is not known");
    FixWall::grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
    std::fill(total, total + NUMBERS, 0.0);
}

FixWall::~FixWall()
{
    if (copymode)
        return;
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
}

int FixWall::read_walls(int narg, char **arg)
{
    if (narg >= 2 && std::strcmp(arg[0], "region") == 0) {
        region_name = arg[1];
        if (narg < 4 || std::strcmp(arg[2], "curved") != 0)
            return 2;
        if (std::strcmp(arg[3], "plane") != 0)
            refuse(fmt::format("curved {} is not plane", arg[3]));
        takes_curved = true;
        return 4;
    }
    for (int k = 0; k < 3; ++k)
        if (narg >= 1 && std::strcmp(arg[0], PLANES[k]) == 0)
            axis = k;
    if (axis < 0)
        refuse(narg < 1 ? "walls are missing: xplane, yplane, zplane or region"
                        : fmt::format("does not know {}; walls are xplane, yplane, zplane or region", arg[0]));
    if (narg < 3)
        refuse(fmt::format("{}: two places are missing after it, numbers, v_name or NULL", arg[0]));
    if (domain->periodicity[axis])
        refuse(fmt::format("{}: the box is periodic across the walls", arg[0]));
    for (int side = 0; side < 2; ++side)
        read_place(side, arg[1 + side]);
    return 3;
}

void FixWall::read_place(int side, const char *text)
{
    place[side] = INFINITY;
    if (std::strcmp(text, "NULL") == 0)
        return;
    if (utils::strmatch(text, "^v_"))
        place_variable[side] = text + 2;
    else
        place[side] = utils::numeric(FLERR, text, false, lmp);
}

int FixWall::setmask()
{
    return POST_FORCE | MIN_POST_FORCE;
}

void FixWall::init()
{
    if (!atom->radius_flag)
        refuse("atoms have no radius; use 'atom_style sphere'");
    check_units(lmp, WHO);
    sum = NAN;
    if (!region_name.empty() && !(region = domain->get_region_by_id(region_name)))
        refuse(fmt::format("region {} is not there", region_name));
    if (region && law.is_viscous() && region->dynamic_check())
        refuse(fmt::format("viscosity: region {} moves, and its speed is not known", region_name));
    if (region)
        most = std::max(most, region->cmax);
    if (film.is_there()) {
        int is_double, columns;
        if (law.is_drained())
            refuse("film: goes with a held volume");
        if (atom->find_custom(film.name.c_str(), is_double, columns) < 0 || is_double != 1 || columns != 0)
            refuse(fmt::format("film {} is not there; make it by 'fix ID all property/atom d_{}'", film.name, film.name));
    }
}

void FixWall::setup(int vflag)
{
    post_force(vflag);
}

void FixWall::min_setup(int vflag)
{
    post_force(vflag);
}

/* -- A step --------------------------------------------------------------------------------------------------------- */

void FixWall::post_force(int vflag)
{
    if (law.refresh())
        sum = NAN;
    move();
    v_init(vflag);
    std::fill(total, total + NUMBERS, 0.0);
    is_summed = false;
    pulled.clear();
    for (int i = 0; i < atom->nlocal; ++i) {
        kept[i] = 0.0;
        if (atom->mask[i] & groupbit)
            look_at(i);
    }
    vector_atom = kept.data();
}

void FixWall::move()
{
    if (region) {
        region->prematch();
        return;
    }
    for (int side = 0; side < 2; ++side) {
        if (place_variable[side].empty())
            continue;
        const int index = input->variable->find(place_variable[side].c_str());
        if (index < 0 || !input->variable->equalstyle(index))
            refuse(fmt::format("variable {} is not there, or not of equal style", place_variable[side]));
        modify->clearstep_compute();
        place[side] = input->variable->compute_equal(index);
        modify->addstep_compute(update->ntimestep + 1);
    }
}

void FixWall::find_faces(int i, double range)
{
    const double *x = atom->x[i];
    faces.clear();
    for (int side = 0; side < 2 && !region; ++side) {
        if (!std::isfinite(place[side]))
            continue;
        Face face = {side, {0.0, 0.0, 0.0}, side == 0 ? x[axis] - place[0] : place[1] - x[axis]};
        face.way[axis] = side == 0 ? -1.0 : 1.0;
        faces.push_back(face);
    }
    if (!region)
        return;
    const int found = region->surface(x[0], x[1], x[2], range);
    for (int k = 0; k < found; ++k) {
        const Region::Contact &contact = region->contact[k];
        if (contact.radius != 0.0 && !takes_curved)
            refuse(fmt::format("region {} is curved; add 'curved plane' to take its surface for a plane at each grain",
                region_name));
        faces.push_back({contact.iwall,
            {-contact.delx / contact.r, -contact.dely / contact.r, -contact.delz / contact.r}, contact.r});
    }
}

/* Attraction of a grain to a wall; 0 from the rupture distance on. Most grains are of one size, and touch: what was
   found for one serves the next. */
double FixWall::attraction(int i, double held, double separation)
{
    const double radius = atom->radius[i];
    const Solids solids = {radius, PLANE};
    if (sum != radius || bridge.held != held) {
        touching = law.renew(bridge, held, solids);
        sum = radius;
        if (std::isnan(touching))
            error->one(FLERR, "{}: atom {}: {}", WHO, atom->tag[i], law.refusal(held, solids));
    }
    const double found = law.pull(bridge, solids, touching, separation);
    if (std::isnan(found))
        error->one(FLERR, "{}: atom {}: {}", WHO, atom->tag[i], law.refusal(held, solids));
    return found;
}

/* What a bridge would take that forms now. */
double FixWall::film_for(int i)
{
    if (!film.is_there())
        return law.control();
    int is_double, columns;
    const double *on_grains = atom->dvector[atom->find_custom(film.name.c_str(), is_double, columns)];
    return std::min(law.control(), film.share * std::max(on_grains[i], 0.0));
}

void FixWall::add_to_film(int i, double volume)
{
    int is_double, columns;
    if (film.is_there())
        atom->dvector[atom->find_custom(film.name.c_str(), is_double, columns)][i] += volume;
}

/* Separation up to which there may be a bridge. */
double FixWall::range_of(int i) const
{
    double range = law.formation;
    for (const Held &held : held_by[i])
        range = std::max(range, law.rupture(law.is_drained() ? law.control() : held.held, {atom->radius[i], PLANE}));
    return range;
}

/* Bridges that stand, break and form. */
void FixWall::look_at(int i)
{
    std::vector<Held> &list = held_by[i];
    const double radius = atom->radius[i];
    find_faces(i, radius + range_of(i));
    for (size_t k = list.size(); k-- > 0;) {
        const int number = list[k].face;
        const auto face
            = std::find_if(faces.begin(), faces.end(), [number](const Face &f) { return f.number == number; });
        const double held = law.is_drained() ? law.control() : list[k].held;
        if (face != faces.end() && attraction(i, held, face->distance - radius) != 0.0) {
            pull(i, *face, held);
            face->number = -1; /* is looked after */
            continue;
        }
        add_to_film(i, list[k].held);
        list.erase(list.begin() + static_cast<long>(k));
        if (face != faces.end())
            face->number = -1;
    }
    for (const Face &face : faces) {
        const double separation = face.distance - radius;
        if (face.number < 0 || separation > law.formation)
            continue;
        const double held = film_for(i);
        const double end = law.rupture(held, {radius, PLANE});
        if (std::isnan(end) && held == law.control())
            error->one(FLERR, "{}: atom {}: {}", WHO, atom->tag[i], law.refusal(held, {radius, PLANE}));
        if (!(separation < end))
            continue;
        list.push_back({face.number, held});
        add_to_film(i, -held);
        pull(i, face, held);
    }
}

void FixWall::pull(int i, const Face &face, double held)
{
    const double separation = face.distance - atom->radius[i];
    const Solids solids = {atom->radius[i], PLANE};
    const double *way = face.way, *v = atom->v[i], arm = -face.distance;
    double force = attraction(i, held, separation);
    if (law.is_viscous())
        force += law.drag(held, solids, separation, -(v[0] * way[0] + v[1] * way[1] + v[2] * way[2]));
    for (int k = 0; k < 3; ++k) {
        atom->f[i][k] += force * way[k];
        total[FORCE_X + k] -= force * way[k];
    }
    const double volume = law.volume(held, solids, separation);
    kept[i] += volume;
    total[BRIDGES] += 1.0;
    total[LIQUID] += volume;
    pulled.push_back({atom->radius[i], held, separation});
    if (evflag) {
        double virial[6] = {way[0] * way[0], way[1] * way[1], way[2] * way[2], way[0] * way[1], way[0] * way[2],
            way[1] * way[2]};
        for (double &part : virial)
            part *= arm * force;
        v_tally(i, virial);
    }
}

/* -- Answers -------------------------------------------------------------------------------------------------------- */

double FixWall::compute_vector(int n)
{
    if (!is_summed) {
        for (const Pulled &of : pulled)
            total[ENERGY] += law.energy(of.held, {of.radius, PLANE}, of.separation);
        MPI_Allreduce(total, total_of_all, NUMBERS, MPI_DOUBLE, MPI_SUM, world);
        is_summed = true;
    }
    return total_of_all[n];
}

double FixWall::compute_scalar()
{
    return compute_vector(ENERGY);
}

/* -- Atoms on their way --------------------------------------------------------------------------------------------- */

void FixWall::grow_arrays(int most_atoms)
{
    held_by.resize(most_atoms);
    kept.resize(most_atoms, 0.0);
    vector_atom = kept.data();
}

void FixWall::copy_arrays(int i, int j, int)
{
    held_by[j] = held_by[i];
    kept[j] = kept[i];
}

void FixWall::set_arrays(int i)
{
    held_by[i].clear();
    kept[i] = 0.0;
}

int FixWall::pack_exchange(int i, double *buffer)
{
    int size = 0;
    buffer[size++] = kept[i];
    buffer[size++] = static_cast<double>(held_by[i].size());
    for (const Held &held : held_by[i]) {
        buffer[size++] = held.face;
        buffer[size++] = held.held;
    }
    return size;
}

int FixWall::unpack_exchange(int i, double *buffer)
{
    int size = 0;
    kept[i] = buffer[size++];
    held_by[i].resize(static_cast<size_t>(buffer[size++]));
    for (Held &held : held_by[i]) {
        held.face = static_cast<int>(buffer[size++]);
        held.held = buffer[size++];
    }
    return size;
}

int FixWall::pack_restart(int i, double *buffer)
{
    const int size = 1 + pack_exchange(i, buffer + 1);
    buffer[0] = size;
    return size;
}

void FixWall::unpack_restart(int i, int nth)
{
    double *extra = atom->extra[i];
    for (int k = 0; k < nth; ++k)
        extra += static_cast<int>(extra[0]);
    unpack_exchange(i, extra + 1);
}

int FixWall::size_restart(int i)
{
    return 3 + 2 * static_cast<int>(held_by[i].size());
}

int FixWall::maxsize_restart()
{
    return 3 + 2 * most;
}

double FixWall::memory_usage()
{
    return static_cast<double>(held_by.capacity()) * (sizeof(std::vector<Held>) + sizeof(double));
}

}    // namespace pendular_lammps
