#pragma once
// The engine's own headers. They must come after those of the standard library.
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

// clang-format off
#include <liggghts/lammps.h>
#include <liggghts/pointers.h>
#include <liggghts/atom.h>
#include <liggghts/atom_vec.h>
#include <liggghts/comm.h>
#include <liggghts/domain.h>
#include <liggghts/error.h>
#include <liggghts/fix.h>
#include <liggghts/force.h>
#include <liggghts/memory.h>
#include <liggghts/modify.h>
#include <liggghts/neigh_list.h>
#include <liggghts/neighbor.h>
#include <liggghts/pair.h>
#include <liggghts/universe.h>
#include <liggghts/update.h>
// clang-format on
