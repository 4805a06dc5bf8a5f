#include "continuum/mesh/ranks.hpp"

#include <mpi.h>
#include <unistd.h>

#include "continuum/mesh/mpi_session.hpp"

namespace couloir {

Ranks Ranks::of_program() {
  use_mpi();
  Ranks r;
  MPI_Comm_size(MPI_COMM_WORLD, &r.count_);
  MPI_Comm_rank(MPI_COMM_WORLD, &r.mine_);
  return r;
}

void Ranks::greatest(std::vector<double>& values) const {
  if (alone()) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

double Ranks::total(double own) const {
  double sum = own;
  if (!alone()) MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return sum;
}

// The first has the word: the others leave it the time to say it.
void Ranks::end_all(int exit_code) {
  int begun = 0;
  MPI_Initialized(&begun);
  const Ranks r = begun ? of_program() : Ranks();
  if (r.alone()) return;
  if (!r.first()) sleep(2);
  MPI_Abort(MPI_COMM_WORLD, exit_code);
}

void Ranks::any(std::vector<char>& flags) const {
  if (alone()) return;
  MPI_Allreduce(MPI_IN_PLACE, flags.data(), static_cast<int>(flags.size()), MPI_BYTE, MPI_BOR, MPI_COMM_WORLD);
}

void Ranks::exchange(const std::vector<std::vector<double>>& out, std::vector<std::vector<double>>& in) const {
  std::vector<MPI_Request> under_way;
  const auto post = [&](auto&& start) { start(&under_way.emplace_back()); };
  for (int r = 0; r < count_; ++r) {
    if (in[r].empty()) continue;
    post([&](MPI_Request* q) { MPI_Irecv(in[r].data(), static_cast<int>(in[r].size()), MPI_DOUBLE, r, 0, MPI_COMM_WORLD, q); });
  }
  for (int r = 0; r < count_; ++r) {
    if (out[r].empty()) continue;
    post([&](MPI_Request* q) { MPI_Isend(out[r].data(), static_cast<int>(out[r].size()), MPI_DOUBLE, r, 0, MPI_COMM_WORLD, q); });
  }
  MPI_Waitall(static_cast<int>(under_way.size()), under_way.data(), MPI_STATUSES_IGNORE);
}

std::vector<std::uint8_t> Ranks::gather(const std::vector<std::uint8_t>& own) const {
  if (alone()) return own;
  std::vector<int> sizes(count_), starts(count_, 0);
  const int size = static_cast<int>(own.size());
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (int r = 1; r < count_; ++r) starts[r] = starts[r - 1] + sizes[r - 1];
  std::vector<std::uint8_t> all(starts.back() + sizes.back());
  MPI_Allgatherv(own.data(), size, MPI_BYTE, all.data(), sizes.data(), starts.data(), MPI_BYTE, MPI_COMM_WORLD);
  return all;
}

}  // namespace couloir
