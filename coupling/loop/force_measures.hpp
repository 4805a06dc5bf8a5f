#pragma once
// Forces by other measures than ObstacleForce, from the continuum: what agrees with what is a check of the run.
//
//   control_volume      on every obstacle: the momentum balance of the box two cells around its base. Equal to ObstacleForce to
//                       round-off, unless something is wrong; round an obstacle of method planes also what turns the flow about
//                       its convex edges, which ObstacleForce leaves out. Not for an obstacle whose box holds another's cells
//   elevation           on an obstacle by elevation: (7.1), (7.2) as the dissertation sums them,
//                       rho sum of g cos(zeta) dz_b/dx h dx dy over its cells
//   elevation_upstream  the same over the cells that rise down the slope, dz_b/dx > 0: the front
//   wall                on a side of the domain that is a wall: momentum and pressure through it
//
// In mode coupled an obstacle whose box meets the zone has none of the first three.

#include <array>
#include <string>
#include <vector>

#include "continuum/flow_model.hpp"
#include "coupling/checkpoint/archive.hpp"
#include "coupling/loop/observer.hpp"
#include "coupling/scene/scene.hpp"

namespace couloir {

inline constexpr std::array<const char*, 4> side_names{"upstream", "downstream", "left", "right"};  // as Scene::sides

// The walls of the scene, as measures of kind "wall".
std::vector<ForceMeasure> wall_measures(const Scene&);

class ForceMeasures {
 public:
  // From the solver's present state on; zones: cells that will be covered.
  ForceMeasures(const Scene&, const ReferenceSurface&, FlowModel&, const std::vector<CellBox>& zones);

  const std::vector<ForceMeasure>& list() const { return list_; }
  // Mean [N] since the last call, `window` [s] ago; (x, y), as list(). Walls are read from the solver's budget, so it must have
  // been reset at the last call. elevation*: the mean of the values at both ends.
  std::vector<std::array<double, 2>> read(const FlowModel&, double window);
  void state(Archive& a) { a(boxes_, sums_); }

 private:
  struct Box {
    int id;
    std::array<double, 2> before{};
  };
  struct Sum {
    struct Cell {
      int i, j;
      double x, y;  // rho g cos(zeta) dz_b/dx dx dy, and by y [N/m]
    };
    std::vector<Cell> cells;
    std::array<double, 2> before{};
    std::array<double, 2> now(const FlowModel&) const;
    void state(Archive& a) { a(before); }
  };
  void add_elevation(const Scene&, const ReferenceSurface&, const FlowModel&, const std::vector<CellBox>& zones);

  double density_;
  std::vector<ForceMeasure> list_;  // boxes, sums, walls
  std::vector<Box> boxes_;
  std::vector<Sum> sums_;
  std::vector<int> walls_;
};

}  // namespace couloir
