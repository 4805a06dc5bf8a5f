#pragma once
// What scheme noc has beyond SolverSettings.

namespace couloir {

struct NocSettings {
  // The Froude number below which (2.85), (2.86) take a cell as at rest, that is active. 0: the literal switch, whose jumps keep
  // a deposit trembling for ever; from 0.1 to 0.5 all piles of tests/noc come to rest.
  double creeping_froude = 0.2;
  // Slopes of h, u, v instead of those of h, hu, hv in (3.2). Limited apart, the latter make ripples in fast flow wherever h
  // rises and hu does not, and leave no more than first order there (docs/decisions/0006).
  bool velocity_slopes = false;
};

}  // namespace couloir
