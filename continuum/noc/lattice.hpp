#pragma once
// One of the two staggered lattices of the scheme: the cell centres (x_i, y_j) or the corners (x_{i+1/2}, y_{j+1/2}).
//
//   +---+---+      o centres: 0 <= i < nx      ghosts mirror about the wall:   centre -1 - i <-> i
//   | o | o |      + corners: 0 <= i <= nx                                     corner     -i <-> i, (7.3)-(7.5) as they stand
//   +---+---+

#include <array>
#include <vector>

#include "continuum/flow/closure.hpp"
#include "continuum/flow_model.hpp"
#include "continuum/mesh/block.hpp"
#include "continuum/noc/noc_settings.hpp"
#include "continuum/noc/points.hpp"
#include "continuum/noc/region.hpp"
#include "continuum/noc/terrain.hpp"

namespace couloir::noc {

class Lattice {
 public:
  enum class Kind { centres, corners };
  static constexpr int ghosts = 2;

  Lattice(Kind, const SolverSettings&, const NocSettings&, const Terrain&);
  Lattice(const Lattice&) = delete;
  Lattice& operator=(const Lattice&) = delete;

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int row() const { return nx_ + 2 * ghosts; }
  int at(int i, int j) const { return (j + ghosts) * row() + i + ghosts; }
  // Lower of the two quarter columns (rows) about point i (j); the upper is the next.
  int quarter(int i) const { return 2 * i - (kind_ == Kind::corners ? 1 : 0); }

  void fill_ghosts();
  // Velocities and earth pressure (2.85), (2.86) in the region; returns the greatest of c_x/dx, c_y/dy, (3.23) [1/s].
  double find_state(const Region&);
  // Slopes, predictor and fluxes in the region for a half step of length tau.
  void prepare(const Region&, double tau);
  // Of centres beyond a periodic side: what the cells at the other end have.
  void wrap_points();

  Arrays arrays;            // of the points
  Points points;            // ghosts included
  Three& q = points.q;      // their states
  double* locked;           // 1: at rest, held by friction, or dry; else 0
  double *lost_x, *lost_y;  // what friction, the end of films and the bound of the speed took in the last half step [m2/s]
  Point point(int c) const { return points.at(c); }
  double kx(int c) const { return kx_[c]; }
  double ky(int c) const { return ky_[c]; }

 private:
  void lay_pull();
  void find_velocity(const Region&);
  template <bool earth_pressure>
  double find_rate(int j, int i0, int i1);
  template <class S, bool velocity_slopes>
  void find_slopes(int j, int i0, int i1);
  template <bool friction>
  void predict(int j, int i0, int i1, double tau);
  void close_sides(int j, int i0, int i1, double tau);
  Gradient bed_slope(int i, int j) const;
  int inside(int quarter, int low_side) const;
  double middle(int i, double (Terrain::*value)(int) const) const;  // mean of the two quarter columns

  Kind kind_;
  const SolverSettings& s_;
  NocSettings own_;
  const Terrain& terrain_;
  int nx_, ny_;
  std::vector<double> weight_, kappa_;  // by column
  double *u_, *v_, *kx_, *ky_;          // by point
  double *pull_x_, *pull_y_, *pull_;    // along the slope and down the bed, and their size [m/s2]
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
