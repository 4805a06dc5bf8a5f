#pragma once
// The ground as the sources of (3.10) see it: at the quarter points, the middles of the quadrants that a cell of one lattice
// shares with a cell of the other. Both lattices have the same quarter points.
//
//   cells    |   o   |   o   |      o cell centre, | + corner line: quarter k lies at x0 + (k + 1/2) dx/2,
//   quarters | .   . | .   . |      k = 2i and 2i + 1 in cell i, 2i - 1 and 2i around corner i

#include <functional>
#include <vector>

#include "continuum/mesh/grid.hpp"
#include "continuum/terrain/reference_surface.hpp"

namespace couloir {

struct NocBed {
  using Height = std::function<double(double x, double y)>;  // [m] above the reference surface, at reference coordinates [m]

  Height ground;                  // z_b besides the obstacles; empty: 0
  std::vector<Height> obstacles;  // what each adds to z_b; the force on it is (7.1), (7.2)
};

namespace noc {

struct Gradient {
  double x = 0, y = 0;
};

class Terrain {
 public:
  Terrain(const Grid&, const ReferenceSurface&, const NocBed&, double gravity, bool curvature);

  int quarters_x() const { return nx_; }
  int quarters_y() const { return ny_; }
  double weight(int k) const { return weight_[k]; }  // g cos(zeta) [m/s2]
  double drive(int k) const { return drive_[k]; }    // g sin(zeta) [m/s2]
  double kappa(int k) const { return kappa_[k]; }    // [1/m]; 0 where the closure leaves it out
  double steepest() const { return steepest_; }      // greatest g |sin(zeta)| [m/s2]

  // Rise of z_b over the quadrant's width by that width: the derivative itself where the bed is a plane there, and the mean of
  // the planes that meet where it is not, as (4.9) has it; no step, however thin, falls between the points.
  Gradient slope(int k, int l) const { return level_ ? Gradient{} : slope_[static_cast<std::size_t>(l) * nx_ + k]; }
  // The part of it that is no obstacle's.
  Gradient ground(int k, int l) const { return ground_.empty() ? Gradient{} : ground_[static_cast<std::size_t>(l) * nx_ + k]; }
  bool level() const { return level_; }  // z_b = 0 everywhere

  double height(int i, int j) const;  // z_b at a cell centre [m]

  // The quarter points by the quadrant of the cell that they lie in, [a][b] with 0 the lower one, for inner loops over cells:
  // columns and cells with two more on each side, as Lattice has its points. Beyond the domain stands what is at its other end,
  // which only a periodic one asks for. Where the bed is level there are no slopes.
  struct Columns {
    std::vector<double> weight, drive, kappa;
  };
  struct Slopes {
    std::vector<double> x, y;
  };
  const Columns& columns(int a) const { return columns_[a]; }
  const Slopes& slopes(int a, int b) const { return slopes_[a][b]; }
  // The cells that hold all bed that rises or falls, and all columns with curvature.
  const CellBox& relief() const { return relief_; }
  const CellBox& arc() const { return arc_; }

  struct QuarterSlope {
    int k, l;
    Gradient slope;
  };
  // Where an obstacle tilts the bed.
  const std::vector<QuarterSlope>& obstacle(int id) const { return obstacles_[id]; }
  int obstacles() const { return static_cast<int>(obstacles_.size()); }

 private:
  void lay_bed(const NocBed&);
  void lay_quadrants();

  Grid grid_;
  int nx_ = 0, ny_ = 0;
  bool level_ = true;
  CellBox relief_, arc_;
  double steepest_ = 0;
  std::vector<double> weight_, drive_, kappa_, height_;
  std::vector<Gradient> slope_, ground_;
  Columns columns_[2];
  Slopes slopes_[2][2];
  std::vector<std::vector<QuarterSlope>> obstacles_;
};

}  // namespace noc
}  // namespace couloir
