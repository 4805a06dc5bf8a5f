#pragma once
// Watches the grains' energy: contacts take it away or store it, never make it. A run that blows up ends at once, with its cause.
//
//   E = sum of (kinetic + m g z) over all grains;  unexplained = max(0, unexplained + change of E - given)
//   given: what inserted grains brought, less what removed ones took, plus at most |impulse of driving| times the fastest of what
//   drives
//
// Contacts give back what they have stored, which is at most the kinetic energy that went before. So unexplained energy above
// the largest kinetic energy that was explained, and the weight of all grains times a diameter (contacts at rest), is a fault. So
// is an overlap of more than a radius.

#include "coupling/engine/engine_error.hpp"
#include "coupling/engine/grain_engine.hpp"

namespace couloir {

class EnergyGuard {
 public:
  // stable_step [s]: of the set-up's grains; the message tells how its time step compares with it.
  EnergyGuard(const EngineSetup&, double stable_step);

  // After each advance since the engine's start; `before`: the grains as reported until then. Throws NumericsError naming the
  // step and the likely cause.
  void look(const AdvanceRequest&, const Grains& before, const Advanced&);

  // What ran away in the engine itself, in the same words.
  [[noreturn]] void explain(const RunawayError&) const;

  struct State {  // [J]
    double energy = 0, unexplained = 0, most_kinetic = 0;
  };
  const State& state() const { return state_; }
  void restore(const State& state) { state_ = state; }

 private:
  double kinetic_and_potential(double mass, const Vec& position, const Vec& velocity) const;
  double brought(const AdvanceRequest&, const Grains& before) const;  // by inserted grains, less what removed ones took
  std::string cause(double overlap) const;

  Vec gravity_;
  double density_, diameter_, timestep_, stable_step_;
  State state_;
};

}  // namespace couloir
