#pragma once
// Small runs of the staggered scheme that several tests share.

#include "continuum/noc/noc_solver.hpp"
#include "tests/continuum/scenes.hpp"
#include "tests/verification/convergence.hpp"

namespace couloir::test {

inline Bits bits_of(const FlowModel& m) {
  Bits b;
  m.gather(b.h, b.hu, b.hv);
  return b;
}

// A quartz heap that slides down 35 deg over a bump and spreads on the run-out. mirror: 1, or -1 for its mirror image.
struct HeapOnBump {
  Grid grid;
  double at, length;   // [m] of the bump: its middle and half its length
  double arc, runout;  // [m]
  double mirror = 1;

  SolverSettings settings(int threads, const std::array<Side, 4>& s4, Limiter limiter) const {
    SolverSettings s;
    s.grid = grid;
    s.closure = quartz();
    s.sides = s4;
    s.threads = threads;
    s.limiter = limiter;
    return s;
  }
  template <class Model>
  Model solver(const SolverSettings& s) const {
    NocBed bed;
    bed.obstacles.push_back([*this](double x, double y) {
      const double a = (x - at) / length, b = (mirror * y - 0.05) / 0.15;
      return std::max(0.0, 0.05 * (1 - a * a - b * b));
    });
    Model solver(s, ReferenceSurface::chute(degrees(35), 0.6, arc, runout), bed);
    solver.set([&](double x, double y) {
      const double r2 = ((x - 0.3) * (x - 0.3) + (mirror * y - 0.03) * (mirror * y - 0.03)) / 0.04;
      const double h = r2 < 1 ? 0.12 * (1 - r2) : 0.0;
      return FlowState{h, 1.5 * h, 0.1 * mirror * h};
    });
    return solver;
  }
};

inline NocSolver heap_on_bump(int threads, std::array<Side, 4> s4 = sides(Side::Kind::outflow, Side::Kind::wall),
                              double mirror = 1, Limiter limiter = Limiter::minmod) {
  const Grid grid{60, 40, 0.02, 1.0 / 64, 0, -20.0 / 64};  // rows mirrored to the bit
  const HeapOnBump heap{grid, 0.7, 0.12, 0.3, 0.3, mirror};
  return heap.solver<NocSolver>(heap.settings(threads, s4, limiter));
}

}  // namespace couloir::test
