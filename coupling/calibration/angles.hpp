#pragma once
// Which slabs show delta and phi, and how they are read.

#include <array>
#include <vector>

#include "coupling/calibration/slab.hpp"

namespace couloir {

// The grains that are tried.
struct TriedGrains {
  double friction = 0.5, rolling_friction = 0.15, base_friction = 0.4, base_rolling_friction = 0.15;
  bool operator==(const TriedGrains&) const = default;
};

// Sizes in diameters d, speeds in sqrt(g d), times in sqrt(d / g).
struct SlabPlan {
  double length = 12, width = 6;
  std::vector<double> delta_depths = {5, 10}, delta_speeds = {5, 10};
  double delta_settling = 10, delta_duration = 20;
  double phi_depth = 10, phi_deep = 20;            // deep: looked at once, where the grains are found; 0: not at all
  std::vector<double> phi_inertias = {0.06, 0.2};  // inertial numbers at the start
  double phi_settling = 8, phi_duration = 30;      // of the depth above; of deeper slabs in proportion
  double window = 2;
  std::vector<long> seeds;

  static SlabPlan full(int replicates);
  static SlabPlan quick(int replicates);  // small, for tests: hundreds of grains
};

// One slab on the flat base.
struct DeltaRow {
  double depth = 0, speed = 0;  // [d], [sqrt(g d)] at the start
  long seed = 0;
  double friction = 0, slip = 0;  // [-] mean over the time measured
};

struct DeltaReading {
  double friction = 0, uncertainty = 0;       // [-] tan(delta); twice the standard error of the replicates, 0 for one
  double depth_change = 0, speed_change = 0;  // [-] deepest less shallowest, fastest less slowest: 0 for a Coulomb law
  std::vector<DeltaRow> rows;
};

// A line mu = mu_0 + slope I through what slabs on the rough base show between I = 0.01 and 0.3.
struct PhiReading {
  double friction = 0, uncertainty = 0;  // [-] tan(phi) = mu_0 of all replicates; twice the standard error of theirs, 0 for one
  double slope = 0;                      // [-]
  double mean = 0;                       // [-] of mu over the points of the line
  bool low = false;                      // points reach below I = 0.1; false: there is no line, `friction` is the mean
  std::vector<std::array<double, 3>> points;  // replicate, I, mu
};

// `stock`: material, diameter and contact law; its block's sizes and seed are the plan's.
std::vector<SlabSpec> delta_slabs(const SlabPlan&, const PackingSpec& stock, const TriedGrains&, double tan_delta);
DeltaReading read_delta(const SlabPlan&, const std::vector<SlabCurve>&);

std::vector<SlabSpec> phi_slabs(const SlabPlan&, const PackingSpec& stock, const TriedGrains&, double tan_incline, double depth);
PhiReading read_phi(const SlabPlan&, const std::vector<SlabCurve>&);

}  // namespace couloir
