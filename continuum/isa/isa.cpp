#include "continuum/isa/isa.hpp"

#include <algorithm>
#include <cstdlib>

namespace couloir {
namespace {

constexpr Isa all_isas[] = {Isa::baseline, Isa::avx2, Isa::avx512};

bool machine_has(Isa isa) {
#ifdef __x86_64__
  switch (isa) {
    case Isa::baseline:
      return true;
    case Isa::avx2:
      return __builtin_cpu_supports("x86-64-v3");
    case Isa::avx512:
      return __builtin_cpu_supports("x86-64-v4");
  }
#endif
  return isa == Isa::baseline;
}

}  // namespace

std::string to_string(Isa isa) {
  return isa == Isa::avx512 ? "avx512" : isa == Isa::avx2 ? "avx2" : "baseline";
}

std::vector<Isa> usable_isas() {
  std::vector<Isa> usable;
  for (Isa isa : all_isas) {
    if (machine_has(isa)) usable.push_back(isa);
  }
  return usable;
}

Isa chosen_isa() {
  const std::vector<Isa> usable = usable_isas();
  const char* asked = std::getenv("COULOIR_ISA");
  if (!asked || !*asked) return usable.back();
  const auto named = std::ranges::find(all_isas, asked, [](Isa isa) { return to_string(isa); });
  if (named == std::end(all_isas)) {
    throw IsaError("COULOIR_ISA is '" + std::string(asked) +
                   "', which is no instruction set; use baseline, avx2 or avx512, or unset it.");
  }
  if (std::ranges::find(usable, *named) == usable.end()) {
    throw IsaError("COULOIR_ISA is " + to_string(*named) + ", which this machine or this build has not got; use at most " +
                   to_string(usable.back()) + ", or unset it.");
  }
  return *named;
}

}  // namespace couloir
