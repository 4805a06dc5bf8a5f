#pragma once
// Whether the shallow model holds where the flow meets an obstacle, and on arcs: what it leaves out, as plain numbers with a
// limit each, before anything is computed. `couloir plan` shows them; `grains.zone: auto` follows them (zone.hpp).
//
// The model of Savage and Hutter (1989) takes depths as small against all lengths along the bed and accelerations along the
// normal as small against gravity. A flow of depth h, velocity u and Fr = u / sqrt(g cos(zeta) h) that must turn by an angle
// theta over a length l does so along a path of curvature kappa = theta / (l + h), since no grain path turns within less than the
// depth:
//
//   slope         theta                              45 deg: beyond, the solver itself turns the flow back as by a wall
//   curvature     kappa h                            0.3: depths are measured along normals, which converge within 1 / kappa
//   acceleration  Fr^2 kappa h                       0.5 of g cos(zeta): the model's pressure is hydrostatic; on the arc, whose
//                                                    curvature it has, this is no test
//   jump          (sqrt(1 + 8 Fr^2) - 1) / 2         2: depth behind a jump over that before it (Belanger); no higher than the
//                                                       obstacle lets it be
//   lift          -kappa u^2 over g cos(zeta)        1: over a brink faster material would leave the bed, which the model
//                                                       cannot let it
//   release       its depth over its length          0.5: a taller column falls before it flows, and its front comes later and
//   denser
//                                                       than the model's
//   grains        h / d                              at least 5 grains deep, where the grains' diameter is known

#include <string>
#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

// How the flow must turn to climb an obstacle: by which angle, within which length of bed.
struct Turn {
  double angle = 0, length = 0;  // [rad], [m]
};
// `depth` of the flow: of a mesh only faces count that are as high, or half as high as the obstacle.
Turn turn_at(const ObstacleSpec&, double depth);

struct ShallowTest {
  std::string name;  // "slope of its front"
  std::string text;  // "90 deg, limit 45 deg"
  double value = 0, limit = 0;
  bool holds = true;
};

struct ShallowVerdict {
  std::string place;  // an obstacle's name, "arc" or "arc at 600 mm", or "the release"
  bool obstacle = false;
  std::vector<ShallowTest> tests;
  bool holds() const;
  // "fails at wall: slope of its front 90 deg, limit 45 deg; ... (what it keeps to)" or "holds at mound: ...".
  std::string sentence() const;
};

// For each obstacle in the scene's order, for each arc of the terrain that the flow reaches, and for a finite release.
// All but the last decide: too few grains for a continuum is told, but no reason for a zone of its own.
std::vector<ShallowVerdict> shallow_verdicts(const Scene&);
ShallowVerdict shallow_verdict(const Scene&, const ObstacleSpec&);

}  // namespace couloir
