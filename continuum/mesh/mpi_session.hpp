#pragma once
// MPI, begun when somebody needs it and ended with the program.

#include <string>

namespace couloir {

void use_mpi();

// What meshes and ranks are built on: "p4est 2.2, Open MPI v4.1.4". Needs no MPI that has begun.
std::string mesh_library_versions();

}  // namespace couloir
