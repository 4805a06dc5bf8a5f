#pragma once
// One of the two staggered lattices of the scheme: the cell centres (x_i, y_j) or the corners (x_{i+1/2}, y_{j+1/2}).
//
//   +---+---+      o centres: 0 <= i < nx      ghosts mirror about the wall:   centre -1 - i <-> i
//   | o | o |      + corners: 0 <= i <= nx                                     corner     -i <-> i, (7.3)-(7.5) as they stand
//   +---+---+

#include <array>
#include <cmath>
#include <vector>

#include "continuum/flow/closure.hpp"
#include "continuum/flow_model.hpp"
#include "continuum/mesh/block.hpp"
#include "continuum/noc/noc_settings.hpp"
#include "continuum/noc/terrain.hpp"

namespace couloir::noc {

// std::hypot guards against overflow at many times the cost.
inline double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

// What a point holds and how it will share it out in the next half step.
struct Point {
  FlowState q;               // at t^n
  FlowState x, y;            // slopes times a quarter of the spacing, (3.5)
  FlowState half;            // at t^{n+1/2}, (3.8)
  FlowState flux_x, flux_y;  // dt/(2 dx) f, dt/(2 dy) g at t^{n+1/2}: one of the two terms of (3.6), (3.7)
  double keep = 1;           // share of slopes and fluxes that is kept, so that no depth falls below zero
  double reach = 0;          // [m/s] no flow that starts here is faster at the end of the half step
};

class Lattice {
 public:
  enum class Kind { centres, corners };
  static constexpr int ghosts = 2;

  Lattice(Kind, const SolverSettings&, const NocSettings&, const Terrain&);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int row() const { return nx_ + 2 * ghosts; }
  int at(int i, int j) const { return (j + ghosts) * row() + i + ghosts; }
  CellBox clamp(const CellBox&) const;
  // Lower of the two quarter columns (rows) about point i (j); the upper is the next.
  int quarter(int i) const { return 2 * i - (kind_ == Kind::corners ? 1 : 0); }

  void fill_ghosts();
  // Velocities and earth pressure (2.85), (2.86) in the box; returns the greatest of c_x/dx, c_y/dy, (3.23) [1/s].
  double find_state(const CellBox&);
  // Slopes, predictor and fluxes in the box for a half step of length tau.
  void prepare(const CellBox&, double tau);

  Fields q;                  // ghosts included
  std::vector<char> locked;  // 1: at rest, held by friction, or dry
  std::vector<Point> points;
  double kx(int c) const { return kx_[c]; }
  double ky(int c) const { return ky_[c]; }

 private:
  void find_earth_pressure(int c, double wave);
  template <class S>
  void prepare_row(int j, int i0, int i1, double tau);
  void predict(Point&, int i, int j, int c, double tau) const;
  Gradient bed_slope(int i, int j) const;
  int inside(int quarter, int low_side) const;
  double middle(int i, double (Terrain::*value)(int) const) const;  // mean of the two quarter columns

  Kind kind_;
  const SolverSettings& s_;
  NocSettings own_;
  const Terrain& terrain_;
  int nx_, ny_;
  std::vector<double> u_, v_, kx_, ky_;
  std::vector<double> weight_, drive_, kappa_;  // by column, of the points
};

// Where the ghost index i of n points takes its value from.
struct GhostSource {
  int index;
  bool mirrored = false;  // normal momentum turned
  bool fixed = false;     // the side's inflow
  bool one_way = false;   // mirrored where it would flow in
};
GhostSource ghost_source(int i, int n, Lattice::Kind, const Side& low, const Side& high);

}  // namespace couloir::noc
