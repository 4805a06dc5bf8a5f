#pragma once
// Small runs that several tests share.

#include <cmath>
#include <vector>

#include "continuum/solver.hpp"

namespace couloir::test {

constexpr double pi = 3.14159265358979323846;
inline double degrees(double a) {
  return a * pi / 180;
}

inline std::array<Side, 4> sides(Side::Kind x, Side::Kind y) {
  std::array<Side, 4> s;
  s[0].kind = s[1].kind = x;
  s[2].kind = s[3].kind = y;
  return s;
}

// Frictionless, hydraulic, walls all round; lower corner at (0, -width/2).
inline SolverSettings basin(int nx, int ny, double dx) {
  SolverSettings s;
  s.grid = {nx, ny, dx, dx, 0, -0.5 * ny * dx};
  s.sides = sides(Side::Kind::wall, Side::Kind::wall);
  s.block = 16;
  return s;
}

// Quartz on a chute bed, phi 40 deg, delta 28 deg.
inline Closure quartz() {
  return {EarthPressure::active_passive(degrees(40), degrees(28)), std::tan(degrees(28)), true};
}

struct Bits {
  std::vector<double> h, hu, hv;
  bool operator==(const Bits&) const = default;
};
inline Bits bits(const Solver& s) {
  Bits b;
  s.gather(b.h, b.hu, b.hv);
  return b;
}

// A quartz heap that slides down 35 deg onto a block, spills over and around it.
inline Solver heap_on_block(int threads, double mirror = 1) {
  SolverSettings s;
  s.grid = {60, 40, 0.02, 0.02, 0, -0.4};
  s.closure = quartz();
  s.sides = sides(Side::Kind::outflow, Side::Kind::wall);
  s.block = 16;
  s.threads = threads;
  StepBed bed;
  bed.obstacles.push_back({"block", 0.7, 0.8, mirror > 0 ? -0.12 : -0.2, mirror > 0 ? 0.2 : 0.12, 0.06});
  Solver solver(s, ReferenceSurface::chute(degrees(35), 0.6, 0.3, 0.3), bed);
  solver.set([&](double x, double y) {
    const double r2 = ((x - 0.3) * (x - 0.3) + (mirror * y - 0.03) * (mirror * y - 0.03)) / 0.04;
    const double h = r2 < 1 ? 0.12 * (1 - r2) : 0.0;
    return FlowState{h, 1.5 * h, 0.1 * mirror * h};
  });
  return solver;
}

}  // namespace couloir::test
