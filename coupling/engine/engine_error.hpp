#pragma once
// A grain engine failed, died or did not answer: exit code 4.
#include <stdexcept>
#include <string>

namespace couloir {

// what() is the whole sentence and ends with the engine's own words and the tail of its log.
struct EngineError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The engine works, its grains do not: they have left the box, or their motion is no finite number any more.
struct RunawayError : EngineError {
  using EngineError::EngineError;
};

// The worker answers, and says that it could not do it.
struct EngineReport : EngineError {
  using EngineError::EngineError;
};

}  // namespace couloir
