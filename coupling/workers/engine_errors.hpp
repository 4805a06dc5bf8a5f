#pragma once
// The engine's ways to report an error end the process: exit(1), MPI_Abort. Our executable defines these functions itself, and
// the loader prefers ours to those of the engine's library. They throw.

#include <stdexcept>

namespace couloir {

// After one, the engine's instance is of no more use.
struct EngineFailure : std::runtime_error {
  EngineFailure(const std::string& what, bool on_all_ranks, bool ran_away = false)
      : std::runtime_error(what), everywhere(on_all_ranks), runaway(ran_away) {}
  bool everywhere;  // every rank throws it at the same place
  bool runaway;     // RunawayError, coupling/engine/engine_error.hpp
};

}  // namespace couloir
