#include "continuum/mesh/ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "continuum/mesh/mpi_session.hpp"

namespace couloir {
namespace {

bool mpi_begun() {
  int begun = 0;
  MPI_Initialized(&begun);
  return begun != 0;
}

int counted(std::size_t n) {
  if (n > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("The ranks tell each other more at once than MPI can count; use larger cells, or fewer ranks.");
  return static_cast<int>(n);
}

template <class F>
void for_pieces(std::size_t size, std::int64_t most, F&& f) {
  for (std::size_t at = 0; at < size;) {
    const int count = static_cast<int>(std::min<std::int64_t>(most, static_cast<std::int64_t>(size - at)));
    f(at, count);
    at += count;
  }
}

}  // namespace

Ranks Ranks::of_program() {
  use_mpi();
  Ranks r;
  MPI_Comm_size(MPI_COMM_WORLD, &r.count_);
  MPI_Comm_rank(MPI_COMM_WORLD, &r.mine_);
  return r;
}

void Ranks::greatest(std::vector<double>& values) const {
  if (alone()) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), counted(values.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

double Ranks::total(double own) const {
  double sum = own;
  if (!alone()) MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return sum;
}

void Ranks::end_all(int exit_code) {
  if (mpi_begun() && !of_program().alone()) MPI_Abort(MPI_COMM_WORLD, exit_code);
}

bool Ranks::is_another() {
  if (mpi_begun()) return !of_program().first();
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}) {
    if (const char* rank = std::getenv(name)) return std::string(rank) != "0";
  }
  return false;
}

void Ranks::any(std::vector<char>& flags) const {
  if (alone()) return;
  MPI_Allreduce(MPI_IN_PLACE, flags.data(), counted(flags.size()), MPI_BYTE, MPI_BOR, MPI_COMM_WORLD);
}

// Pieces of one message arrive in the order in which they were sent.
void Ranks::exchange(const std::vector<std::vector<double>>& out, std::vector<std::vector<double>>& in, std::int64_t most) const {
  std::vector<MPI_Request> under_way;
  const auto in_pieces = [&](auto& values, auto&& start) {
    for_pieces(values.size(), most,
               [&](std::size_t at, int count) { start(values.data() + at, count, &under_way.emplace_back()); });
  };
  for (int r = 0; r < count_; ++r) {
    in_pieces(in[r], [&](double* to, int count, MPI_Request* q) { MPI_Irecv(to, count, MPI_DOUBLE, r, 0, MPI_COMM_WORLD, q); });
  }
  for (int r = 0; r < count_; ++r) {
    in_pieces(out[r],
              [&](const double* of, int count, MPI_Request* q) { MPI_Isend(of, count, MPI_DOUBLE, r, 0, MPI_COMM_WORLD, q); });
  }
  MPI_Waitall(counted(under_way.size()), under_way.data(), MPI_STATUSES_IGNORE);
}

std::vector<std::uint8_t> Ranks::gather(const std::vector<std::uint8_t>& own, std::int64_t most) const {
  if (alone()) return own;
  std::vector<std::int64_t> sizes(count_), starts(count_, 0);
  const auto size = static_cast<std::int64_t>(own.size());
  MPI_Allgather(&size, 1, MPI_INT64_T, sizes.data(), 1, MPI_INT64_T, MPI_COMM_WORLD);
  for (int r = 1; r < count_; ++r) starts[r] = starts[r - 1] + sizes[r - 1];
  std::vector<std::uint8_t> all(starts.back() + sizes.back());
  if (static_cast<std::int64_t>(all.size()) <= most) {
    const std::vector<int> counts(sizes.begin(), sizes.end()), places(starts.begin(), starts.end());
    MPI_Allgatherv(own.data(), counts[mine_], MPI_BYTE, all.data(), counts.data(), places.data(), MPI_BYTE, MPI_COMM_WORLD);
    return all;
  }
  std::copy(own.begin(), own.end(), all.begin() + starts[mine_]);
  for (int r = 0; r < count_; ++r) {
    for_pieces(sizes[r], most,
               [&](std::size_t at, int count) { MPI_Bcast(all.data() + starts[r] + at, count, MPI_BYTE, r, MPI_COMM_WORLD); });
  }
  return all;
}

}  // namespace couloir
