#pragma once
// The instruction set that the continuum's kernels use, chosen at run time: the best that both this program was built with and
// the machine has, or what the environment variable COULOIR_ISA says (baseline, avx2, avx512). All give the same bits.

#include <stdexcept>
#include <string>
#include <vector>

namespace couloir {

enum class Isa { baseline, avx2, avx512 };  // x86-64 as it began, x86-64-v3, x86-64-v4

// COULOIR_ISA names no instruction set, or one that this machine or program has not got: the user's input is wrong.
struct IsaError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string to_string(Isa);

// Those that this program was built with and this machine can run, the widest last; never empty.
std::vector<Isa> usable_isas();

// The widest of them, or that of COULOIR_ISA, which is read anew at each call. Throws IsaError.
Isa chosen_isa();

}  // namespace couloir
