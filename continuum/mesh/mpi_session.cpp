#include "continuum/mesh/mpi_session.hpp"

#include <mpi.h>
#include <p4est.h>
#include <sc.h>

#include <cstdlib>

namespace couloir {
namespace {

void end_mpi() {
  int ended = 0;
  MPI_Finalized(&ended);
  if (!ended) MPI_Finalize();
}

}  // namespace

void use_mpi() {
  int begun = 0;
  MPI_Initialized(&begun);
  if (begun) return;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);  // else a program on its own starts a daemon
  int given = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
  std::atexit(end_mpi);
  sc_init(sc_MPI_COMM_SELF, 0, 0, nullptr, SC_LP_ERROR);
  p4est_init(nullptr, SC_LP_ERROR);
}

std::string mesh_library_versions() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string mpi(text, length);
  return "p4est " P4EST_VERSION ", " + mpi.substr(0, mpi.find(','));  // what follows says who built it
}

}  // namespace couloir
