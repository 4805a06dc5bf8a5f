#pragma once
// The continuum's one error: the numbers left the range in which the scheme is valid.
#include <stdexcept>

namespace couloir {

struct NumericsError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace couloir
