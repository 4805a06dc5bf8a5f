#pragma once
// Small runs that the tests of planes share.

#include <cmath>

#include "continuum/planes/planes_model.hpp"
#include "continuum/solver.hpp"

namespace couloir::test {

inline double degrees(double a) {
  return a * 3.14159265358979323846 / 180;
}

// The dissertation's chapter 6, coarse (the cell has few bits, so that mirrored rows have mirrored centres): Vestolen on 40 deg,
// one unit 33.33 mm, the cuboid's front at 16.5 units.
struct Dam {
  double cell = 5.0 / 512, eta = 0.8, height = 2.4 * 0.03333, zeta = degrees(40), phi = degrees(37), delta = degrees(24);
  int threads = 1;
  double skew = 0;           // [m] the release's middle beside the centre line
  double mirror = 1;         // -1: everything mirrored
  bool hydraulic = false;    // K = 1
  bool whole_width = false;  // the cuboid reaches from side to side, and the sides are walls
};

inline constexpr double unit = 0.03333;  // [m]

inline SolverSettings dam_settings(const Dam& d) {
  SolverSettings s;
  const int nx = static_cast<int>(std::lround(24 * unit / d.cell)), half = static_cast<int>(std::lround(9 * unit / d.cell));
  s.grid = {nx, 2 * half, d.cell, d.cell, 0, -half * d.cell};
  s.closure = {d.hydraulic ? EarthPressure::hydraulic() : EarthPressure::active_passive(d.phi, d.delta), std::tan(d.delta), true};
  s.block = 16;
  s.threads = d.threads;
  if (d.whole_width) s.sides[2].kind = s.sides[3].kind = Side::Kind::wall;
  return s;
}

inline StepBed dam_bed(const Dam& d) {
  const Grid g = dam_settings(d).grid;
  const double half_width = d.whole_width ? -g.y0 : 2.4 * unit;
  StepBed bed;
  bed.obstacles.push_back({"dam", 16.5 * unit, 17.5 * unit, -half_width, half_width, d.height});
  return bed;
}

inline FlowState shallow_cap(const Dam& d, double x, double y) {
  const double a = 4.74 * unit, r2 = std::pow((x - a) / a, 2) + std::pow((d.mirror * y - d.skew) / a, 2);
  return {r2 < 1 ? 1.8 * unit * std::sqrt(1 - r2) : 0.0, 0, 0};
}

inline PlanesModel dam(const Dam& d) {
  PlanesModel model(dam_settings(d), ReferenceSurface::incline(d.zeta, 24 * unit), dam_bed(d), 0, d.eta);
  model.set([&](double x, double y) { return shallow_cap(d, x, y); });
  return model;
}

// The same with a step too high to pass.
inline Solver tall_step(const Dam& d) {
  StepBed bed = dam_bed(d);
  bed.obstacles[0].height = 1;
  Solver solver(dam_settings(d), ReferenceSurface::incline(d.zeta, 24 * unit), bed);
  solver.set([&](double x, double y) { return shallow_cap(d, x, y); });
  return solver;
}

}  // namespace couloir::test
