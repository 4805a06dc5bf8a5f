#pragma once
// The processes that share one run: those of MPI's world. All hold the whole mesh and state; each steps its own blocks.

#include <cstdint>
#include <limits>
#include <vector>

namespace couloir {

class Ranks {
 public:
  Ranks() = default;  // this process alone; MPI is not begun
  // Those of the program; as many as mpirun was told.
  static Ranks of_program();
  // Ends all of the program with this exit code, whatever the others do; returns where there is only one, or MPI is not begun.
  static void end_all(int exit_code);
  // Whether this is one of several and not the first; as long as MPI is not begun, by what mpirun (Open MPI's, or PMI) says.
  static bool is_another();

  int count() const { return count_; }
  int mine() const { return mine_; }
  bool alone() const { return count_ == 1; }
  bool first() const { return mine_ == 0; }

  // All ranks must call these together, with vectors of the same length on all.
  void greatest(std::vector<double>&) const;  // each entry: the greatest of all ranks
  void any(std::vector<char>&) const;         // each entry: the bits that some rank has set
  // What each rank tells each other one, by rank; `in` has the right sizes already.
  void exchange(const std::vector<std::vector<double>>& out, std::vector<std::vector<double>>& in,
                std::int64_t most = most_at_once) const;  // `most` numbers a message
  double total(double) const;                             // the sum over all ranks
  // What all ranks have, one after the other. MPI counts in int: what goes beyond goes in pieces of at most `most` bytes.
  std::vector<std::uint8_t> gather(const std::vector<std::uint8_t>&, std::int64_t most = most_at_once) const;

 private:
  static constexpr std::int64_t most_at_once = std::numeric_limits<int>::max();
  int count_ = 1, mine_ = 0;
};

}  // namespace couloir
