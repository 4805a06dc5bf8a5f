#pragma once
// The user's input is wrong: exit code 2.
#include <stdexcept>

namespace couloir {

// what() is the whole sentence: place, what is wrong, what is allowed or how to mend it.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace couloir
