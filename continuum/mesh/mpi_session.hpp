#pragma once
// MPI, begun when somebody needs it and ended with the program.

namespace couloir {

void use_mpi();

}  // namespace couloir
