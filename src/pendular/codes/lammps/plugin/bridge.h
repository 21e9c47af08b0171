/* Bridges, as they are kept from step to step on the rank that reckons with them. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PENDULAR_LAMMPS_BRIDGE_H
#define PENDULAR_LAMMPS_BRIDGE_H

#include <memory>
#include <vector>

#include "contact.h"
#include "lmptype.h"
#include "pendular.h"

namespace pendular_lammps {

class Law;

/* Have memory brought near before its turn: grains that touch lie in far places of it. */
inline void fetch(const void *place)
{
#ifdef __GNUC__
    __builtin_prefetch(place);
#endif
}

/* A bridge of solids apart, and what was learnt when it was last looked at. */
struct Bridge : Cell {
    double held = 0.0;                     /* suction or volume */
    std::unique_ptr<pendular_state> state; /* to start from, where the solver is asked */
};

/* What no step asks of a bridge whose solids overlap. */
struct Origin {
    LAMMPS_NS::tagint tag1, tag2;
    Law *law;
    double held; /* suction or volume */
};

/* All bridges of a rank, in the order of their first atoms: a step streams through the ends alone. Few bridges are of
   solids apart, and only these have a record. */
struct Bridges {
    std::vector<Ends> ends;
    std::vector<Origin> origin;
    std::vector<int> record; /* its number, -1 if there is none */
    std::vector<Bridge> records;

    int count() const { return static_cast<int>(ends.size()); }

    void clear();
    void reserve(int most);
    void add(const Ends &pair, const Origin &of)
    {
        Ends &end = ends.emplace_back(); /* number by number: the two atoms read as one would wait for their writing */
        end.i = pair.i;
        end.j = pair.j;
        end.sum = pair.sum;
        end.touching = pair.touching;
        Origin &own = origin.emplace_back();
        own.tag1 = of.tag1;
        own.tag2 = of.tag2;
        own.law = of.law;
        own.held = of.held;
        record.push_back(-1);
    }

    /* Made if there was none. */
    Bridge &record_of(int number);
    void drop_record(int number);

    /* The last one takes its number. */
    void remove(int number);

    /* What it holds or a radius is another one: it has to be made anew. */
    void renew(int number) { ends[number].sum = NAN; }

    /* Put those of another set behind, which is left empty. */
    void append(Bridges &);

    double bytes() const;

private:
    std::vector<int> unused; /* records */
};

}    // namespace pendular_lammps

#endif
