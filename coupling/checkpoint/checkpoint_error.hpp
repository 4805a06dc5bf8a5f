#pragma once
// A checkpoint cannot be written or read: exit code 3.
#include <stdexcept>

namespace couloir {

// what() is the whole sentence, with the place.
struct CheckpointError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace couloir
