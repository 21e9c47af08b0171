/* LIGGGHTS with the cohesion model pendular, for a LIGGGHTS that is installed as a library: `make`, see docs/liggghts.md.

   Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty. */
#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include "contact_models.h"
#include "granular_pair_style.h"
#include "granular_wall.h"

#include "fix_insert_stream.h"
#include "fix_wall_gran_base.h"
#include "pair_gran_base.h"

using namespace LIGGGHTS;
using namespace LIGGGHTS::ContactModels;

namespace
{

template<typename Model>
PairStyles::IGranularPairStyle *new_pair(LAMMPS *program, PairGran *parent, int64_t code)
{
    return new PairStyles::Granular<Model>(program, parent, code);
}

template<typename Model>
Walls::IGranularWall *new_wall(LAMMPS *program, FixWallGran *parent, int64_t code)
{
    return new Walls::Granular<Model>(program, parent, code);
}

template<int normal, int tangential, int rolling>
void add_style()
{
    typedef ContactModel<GranStyle<normal, tangential, COHESION_PENDULAR, rolling, SURFACE_DEFAULT> > Model;
    PairStyles::Factory::instance().addStyle("gran", static_cast<int>(Model::STYLE_HASHCODE), &new_pair<Model>);
    Walls::Factory::instance().addStyle("gran", static_cast<int>(Model::STYLE_HASHCODE), &new_wall<Model>);
}

template<int normal>
void add_styles()
{
    add_style<normal, TANGENTIAL_OFF, ROLLING_OFF>();
    add_style<normal, TANGENTIAL_NO_HISTORY, ROLLING_OFF>();
    add_style<normal, TANGENTIAL_HISTORY, ROLLING_OFF>();
    add_style<normal, TANGENTIAL_HISTORY, ROLLING_CDT>();
    add_style<normal, TANGENTIAL_HISTORY, ROLLING_EPSD2>();
}

}

int main(int count, char **words)
{
    MPI_Init(&count, &words);
    ContactModels::Factory::instance().addCohesionModel("pendular", COHESION_PENDULAR);
    add_styles<HERTZ>();
    add_styles<HOOKE>();
    LAMMPS *program = new LAMMPS(count, words, MPI_COMM_WORLD);
    program->input->file();
    delete program;
    MPI_Finalize();
    return 0;
}
