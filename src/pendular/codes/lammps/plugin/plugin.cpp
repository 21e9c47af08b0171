/* What `plugin load` finds in the library: the styles, by name. SPDX-License-Identifier: BSD-3-Clause */
#include "compute_bridges.h"
#include "fix_bridges.h"
#include "fix_wall.h"
#include "lammps.h"
#include "pair_pendular.h"

using namespace LAMMPS_NS;

namespace pendular_lammps {
namespace {
    using Maker = void *(void *);
    using MakerOfArguments = void *(void *, int, char **);

    /* As LAMMPS documents it, for its headers as installed do not have it. */
    struct Style {
        const char *version, *kind, *name, *info, *author;
        union {
            Maker *plain;
            MakerOfArguments *of_arguments;
        } make;
        void *handle;
    };

    void *make_pair(void *lmp) { return static_cast<Pair *>(new PairPendular(static_cast<LAMMPS *>(lmp))); }

    template <class Base, class Made> void *make(void *lmp, int narg, char **arg)
    {
        return static_cast<Base *>(new Made(static_cast<LAMMPS *>(lmp), narg, arg));
    }
}    // namespace
}    // namespace pendular_lammps

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *registrar)
{
    using namespace pendular_lammps;
    const auto add = reinterpret_cast<void (*)(Style *, void *)>(registrar);
    Style style = {static_cast<LAMMPS *>(lmp)->version, "pair", "pendular", "capillary bridges of pendular",
        "the Pendular developers", {}, handle};
    style.make.plain = make_pair;
    add(&style, lmp);
    style.kind = "fix";
    style.name = "pendular/bridges";
    style.make.of_arguments = make<Fix, FixBridges>;
    add(&style, lmp);
    style.name = "pendular/wall";
    style.make.of_arguments = make<Fix, FixWall>;
    add(&style, lmp);
    style.kind = "compute";
    style.name = "pendular/bridges";
    style.make.of_arguments = make<Compute, ComputeBridges>;
    add(&style, lmp);
}
