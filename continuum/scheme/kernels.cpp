#include "continuum/scheme/kernels.hpp"

#include <array>

#include "continuum/isa/isa.hpp"

namespace couloir {

extern "C" const Kernels couloir_scheme_baseline, couloir_scheme_avx2, couloir_scheme_avx512;

const Kernels& kernels() {
  constexpr std::array tables{&couloir_scheme_baseline, &couloir_scheme_avx2, &couloir_scheme_avx512};
  return *tables[static_cast<std::size_t>(chosen_isa())];
}

}  // namespace couloir
