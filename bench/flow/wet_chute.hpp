#pragma once
// The scenes of bench/flow_rate.cpp: a layer of 50 mm on a chute, at 1 m/s with waves of 10 %, periodic across; cells of 10 mm.

#include <cmath>
#include <numbers>
#include <string>

#include "continuum/solver.hpp"

namespace couloir::bench {

constexpr double depth = 0.05, cell = 0.01;

struct Scene {
  int nx = 256, ny = 128, block = 32, threads = 1;
  bool friction = false, active_passive = false, curvature = false, relief = false;
  int levels = 0;  // how often the cells are halved in the middle of the chute, a quarter of it
  int dry = 1;     // only cells with i < nx / dry and j < ny / dry are wet
};

// All of (2.87)-(2.92) but the bed's elevation: friction, active and passive earth pressure, curvature.
inline Scene all_physics() {
  Scene s;
  s.friction = s.active_passive = s.curvature = true;
  return s;
}

inline Solver solver_of(const Scene& s) {
  constexpr double deg = std::numbers::pi / 180;
  SolverSettings settings;
  settings.grid = {s.nx, s.ny, cell, cell, 0, 0};
  settings.sides[2].kind = settings.sides[3].kind = Side::Kind::periodic;
  settings.dry_depth = 1e-6 * depth;
  settings.block = s.block;
  settings.threads = s.threads;
  const double across_chute = s.ny * cell, along = s.nx * cell;
  if (s.levels > 0) {
    settings.refinement.boxes.push_back({0.375 * along, 0.625 * along, 0.375 * across_chute, 0.625 * across_chute, s.levels});
  }
  if (s.active_passive) settings.closure.earth_pressure = EarthPressure::active_passive(37 * deg, 24 * deg);
  settings.closure.tan_delta = s.friction ? std::tan(24 * deg) : 0;
  settings.closure.curvature = s.curvature;
  const double length = s.nx * cell;
  const ReferenceSurface surface = s.curvature ? ReferenceSurface::chute(35 * deg, 0.1 * length, 0.8 * length, 0.1 * length)
                                               : ReferenceSurface::incline(35 * deg, length);
  StepBed bed;
  for (int j = 0; s.relief && j < s.ny; ++j) {
    for (int i = 0; i < s.nx; ++i) {
      const double across = 2 * std::numbers::pi * j / s.ny;
      bed.elevation.push_back(0.005 * (1 + std::sin(40 * settings.grid.x(i)) * std::cos(across)));
    }
  }
  return Solver(settings, surface, bed);
}

// Of cell (i, j).
inline FlowState state_of(const Scene& s, int i, int j) {
  if (i >= s.nx / s.dry || j >= s.ny / s.dry) return {};
  const double x = (i + 0.5) * cell, across = 2 * std::numbers::pi * (j + 0.5) / s.ny;
  return {depth, (1 + 0.1 * std::sin(20 * x)) * depth, 0.05 * std::cos(across) * depth};
}

}  // namespace couloir::bench
