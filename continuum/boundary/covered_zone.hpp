#pragma once
// A covered zone: a box of cells whose material is not the solver's, and the imposed exchange through the faces of its rim.
// A zone edge that lies on the domain's side has no rim there.

#include <array>
#include <functional>
#include <vector>

#include "continuum/boundary/side.hpp"
#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/grid.hpp"

namespace couloir {

class CoveredZone {
 public:
  CoveredZone() = default;
  // Throws std::invalid_argument where the box is empty or leaves the grid.
  CoveredZone(const CellBox&, const Grid&);

  const CellBox& box() const { return box_; }
  int faces(SideName side) const { return static_cast<int>(rim(side).imposed.size()); }
  bool has_rim(SideName side) const { return rim(side).inside_domain; }

  // The active cell outside face k of this side.
  struct Neighbour {
    int i, j;
  };
  Neighbour neighbour(SideName, int k) const;

  // Throw std::out_of_range where there is no face k.
  void impose(SideName, int k, const FaceFlux&);
  const FaceFlux& imposed(SideName, int k) const;
  const FaceFlux& passed(SideName, int k) const;
  void set_passed(SideName, int k, const FaceFlux&);
  void reset_passed();

  // The flow along the face between the zone's side and the cell outside: one state, or those of the finer cells there, from the
  // low end.
  using StatesAlong = std::function<std::vector<FlowState>(SideName, int i, int j)>;
  // Scales each imposed flux, mass and momentum together, so that in dt it takes no more than this share of what the cell
  // outside holds at the depth along the face, together with what also_drawn [m2/s] says that another zone draws through its
  // opposite face. Finer cells give by their depths.
  void limit(double dt, double share, const StatesAlong&, const std::function<double(SideName, int i, int j)>& also_drawn);
  // The flux that really passes in this step.
  const FaceFlux& actual(SideName, int k) const;
  // Through one of the equal parts of the face, counted from the low end; the mean of all parts is actual().
  FaceFlux actual(SideName, int k, int part, int parts) const;
  // Adds dt times the actual flux to passed().
  void count(double dt);

 private:
  struct Rim {
    bool inside_domain = false;
    std::vector<FaceFlux> imposed, actual, passed;
    std::vector<std::vector<double>> weights;  // [k][cell along the face] of the flux through it, in the mean 1
  };
  const Rim& rim(SideName side) const { return rims_[static_cast<int>(side)]; }
  Rim& rim(SideName side) { return rims_[static_cast<int>(side)]; }

  CellBox box_;
  double dx_ = 0, dy_ = 0;
  std::array<Rim, 4> rims_;
};

}  // namespace couloir
