/* Liquid on the grains in LIGGGHTS, of which bridges at constant volume are made, and to which it returns: a part of
   cohesion_model_pendular.h.

   In a step each grain first gets half of the liquid of each of its bridges that broke; then what it offers, a share of
   its film, is parted evenly among the bridges that form on it. No number of a grain or a rank enters, and nothing is
   lost. Two ranks that have the two grains of a bridge each have a copy of it, and come to the same numbers.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#ifndef PENDULAR_LIGGGHTS_FILMS_H
#define PENDULAR_LIGGGHTS_FILMS_H

#include "atom.h"
#include "contact_interface.h"
#include "fix_contact_history.h"
#include "fix_property_atom.h"
#include "modify.h"
#include "neigh_list.h"
#include "pair_gran.h"
#include "pointers.h"

#include <algorithm>
#include <string>
#include <vector>

namespace pendular_liggghts
{
using namespace LAMMPS_NS;

/* A `fix property/atom` of that name, which is made where it is not there. */
inline FixPropertyAtom *numbers_of_grains(
    Modify *modify, const char *name, int count, const char *first, const char *restarts, const char *goes_to_ghosts)
{
    const char *style = count > 1 ? "vector" : "scalar";
    std::vector<const char *> words = { name, "all", "property/atom", name, style, restarts, goes_to_ghosts, "no" };
    if (modify->find_fix(name) < 0) {
        words.insert(words.end(), count, first);
        modify->add_fix(static_cast<int>(words.size()), const_cast<char **>(&words[0]));
    }
    return static_cast<FixPropertyAtom *>(
        modify->find_fix_property(name, "property/atom", style, count > 1 ? count : 0, 0, "cohesion_model pendular"));
}

using LIGGGHTS::ContactModels::SurfacesCloseData;

/* Who knows what a bridge would hold of what is offered; NaN for none. */
class BridgeMaker
{
public:
    virtual ~BridgeMaker() {}
    virtual double held_of(const SurfacesCloseData &contact, double offered) const = 0;
};

class Films : protected Pointers
{
public:
    double share;

    explicit Films(LAMMPS *lmp) : Pointers(lmp), share(1.0), film_(NULL), offer_(NULL) {}

    bool are_there() const { return film_ != NULL; }

    void leave_out() { film_ = NULL; }

    /* Whether the user has made a `fix ID all property/atom film scalar yes yes no V`. */
    bool find()
    {
        film_ = static_cast<FixPropertyAtom *>(
            modify->find_fix_property("film", "property/atom", "scalar", 0, 0, "cohesion_model pendular", false));
        if (film_)
            offer_ = numbers_of_grains(modify, "pendular_offer", 1, "0.0", "no", "yes");
        return are_there();
    }

    /* Liquid on a grain. */
    double &of(int i) { return film_->vector_atom[i]; }

    /* Liquid back to a grain from what a bridge holds, which is negative where a reservoir gives it. */
    void take(int i, double held)
    {
        if (are_there() && held > 0.0 && i < atom->nlocal)
            of(i) += held;
    }

    /* Where one of two grains is gone, or both were put far apart, each that is left has half of the liquid. The
       bridges that the grains knew before the list was made are compared with those in it. */
    void return_lost(const PairGran *pair, int place)
    {
        FixContactHistory *before = static_cast<FixContactHistory *>(modify->find_fix_style_strict("contacthistory", 0));
        std::vector<double> lost(atom->nlocal, 0.0);
        std::vector<int> count(atom->nlocal, 0);
        if (!are_there() || !before)
            return;
        for (int i = 0; i < atom->nlocal; ++i)
            for (int k = 0; k < before->n_partner(i); ++k)
                add(before->contacthistory(i, k)[place], i, 1, lost, count);
        for (int row = 0; row < pair->list->inum; ++row) {
            const int i = pair->list->ilist[row];
            for (int k = 0; k < pair->list->numneigh[i]; ++k) {
                const double held = pair->listgranhistory->firstdouble[i][before->get_dnum() * k + place];
                add(held, i, -1, lost, count);
                add(held, pair->list->firstneigh[i][k] & NEIGHMASK, -1, lost, count);
            }
        }
        for (int i = 0; i < atom->nlocal; ++i)
            if (count[i] != 0)
                of(i) += 0.5 * lost[i];
    }

    /* Two grains that touch and have no bridge. */
    void watch(const SurfacesCloseData &contact) { forming_.push_back(contact); }

    /* All ranks have to call it once in a step. `place` is that of what a bridge holds, in the history of a contact. */
    void form_bridges(const BridgeMaker &maker, int place)
    {
        int is_any = !forming_.empty();
        MPI_Allreduce(MPI_IN_PLACE, &is_any, 1, MPI_INT, MPI_MAX, world);
        if (is_any && !film_->just_created) { /* else LIGGGHTS gives it its first numbers after this pass */
            make_offers();
            for (size_t k = 0; k < forming_.size(); ++k)
                form(forming_[k], maker, place);
        }
        forming_.clear();
    }

private:
    FixPropertyAtom *film_, *offer_; /* an offer is negative where no bridge forms */
    std::vector<SurfacesCloseData> forming_;

    static void add(double held, int i, int sign, std::vector<double> &sum, std::vector<int> &count)
    {
        if (held > 0.0 && i < static_cast<int>(sum.size())) {
            sum[i] += sign * held;
            count[i] += sign;
        }
    }

    void make_offers()
    {
        std::vector<int> count(atom->nlocal, 0);
        for (size_t k = 0; k < forming_.size(); ++k) {
            ++count[forming_[k].i];
            if (forming_[k].j < atom->nlocal)
                ++count[forming_[k].j];
        }
        for (int i = 0; i < atom->nlocal; ++i)
            offer_->vector_atom[i] = count[i] > 0 ? share * std::max(of(i), 0.0) / count[i] : -1.0;
        offer_->do_forward_comm();
    }

    /* A new bridge takes from its grains in proportion to what they offer. It waits until both of their ranks see it. */
    void form(SurfacesCloseData &pair, const BridgeMaker &maker, int place)
    {
        const double own = offer_->vector_atom[pair.i], others = offer_->vector_atom[pair.j], sum = own + others;
        if (own < 0.0 || others < 0.0 || sum == 0.0)
            return;
        const double held = maker.held_of(pair, sum);
        if (held != held)
            return;
        pair.contact_history[place] = held;
        if (pair.contact_flags)
            *pair.contact_flags |= LIGGGHTS::ContactModels::CONTACT_COHESION_MODEL;
        of(pair.i) -= held * (own / sum);
        if (pair.j < atom->nlocal)
            of(pair.j) -= held * (others / sum);
    }
};

}

#endif
