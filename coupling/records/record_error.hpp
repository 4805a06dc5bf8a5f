#pragma once
// A record could not be written or read: exit code 3.
#include <stdexcept>

namespace couloir {

// what() is the whole sentence: the file, what failed in the system's words, and the remedy.
struct RecordError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace couloir
