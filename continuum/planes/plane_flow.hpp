#pragma once
// The depth-averaged flow on one plane of an obstacle: the scheme of the slope's solver on a single block, with what crosses the
// plane's four edges imposed.
//
//   b ^      right = (b high)
//     |   +-----------------+
//     |   | upstream        | downstream       gravity along the plane (drive_a, drive_b), onto it (weight)
//     |   +-----------------+
//     |      left = (b low)
//     +------------------------> a              the side names are those of a grid along (a, b)
//
// A plane that gravity does not press on (weight 0) has no pressure and no friction: its material falls.

#include <array>
#include <string>
#include <vector>

#include "continuum/boundary/side.hpp"
#include "continuum/bytes.hpp"
#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/block.hpp"
#include "continuum/planes/edge_flux.hpp"
#include "continuum/scheme/kernels.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/scratch.hpp"
#include "continuum/scheme/step_faces.hpp"
#include "continuum/scheme/tally.hpp"
#include "continuum/scheme/update.hpp"

namespace couloir {

struct PlaneSettings {
  std::string name;                             // for messages
  Grid grid;                                    // along (a, b)
  double weight = 0, drive_a = 0, drive_b = 0;  // gravity's components [m/s2]; weight >= 0
  bool foot = false;                            // its edge of low a stands on the slope (for the test of rest)
  Closure closure;
  Limiter limiter = Limiter::minmod;
  double cfl = 0.45, dry_depth = 1e-7;
};

class PlaneFlow {
 public:
  explicit PlaneFlow(const PlaneSettings&);

  const Grid& grid() const { return block_.grid; }
  double weight() const { return settings_.weight; }  // [m/s2]
  FlowState at(int i, int j) const;
  void set(int i, int j, const FlowState&);
  double volume() const;                   // [m3]
  std::array<double, 2> momentum() const;  // [m4/s] along (a, b)
  double max_speed() const;                // [m/s]
  double min_depth() const { return min_depth_; }
  int faces(SideName side) const { return is_a(side) ? grid().ny : grid().nx; }

  // Velocities and earth pressure of the present state, which the three below read.
  void refresh();
  double stable_dt() const;  // [s]; infinite while dry
  EdgeCell edge_cell(SideName, int k) const;
  double content(SideName, int k) const;  // [m2] of that cell per length of its edge

  // What crosses the edges from now on, along +a or +b.
  void impose(SideName, int k, const FaceFlux&);
  // Throws NumericsError where a cell would be overdrawn or the state is not finite, naming the plane.
  void step(double dt);

  // Since the last call: gravity, friction, cutoff along (a, b).
  Budget take_budget();
  // Cells stepped, times stages.
  long updates() const { return updates_; }

  void save(ByteWriter&) const;
  void restore(ByteReader&);

  static bool is_a(SideName side) { return side == SideName::upstream || side == SideName::downstream; }

 private:
  void fill_ghosts();
  void find_closures();
  bool at_work() const;  // has material, or gets some
  void limit_outflow(StageName, double dt);
  void loosen_where_it_comes_in();
  void stage(StageName, double dt, Tally&);
  int edge_index(SideName, int k) const;  // of the cell inside

  PlaneSettings settings_;
  Parameters parameters_;
  const Kernels* kernels_ = &kernels();
  Block block_;
  BlockState state_;
  StepFaces no_steps_;
  Scratch scratch_;
  std::array<std::vector<FaceFlux>, 4> imposed_;
  double strained_ = 0;  // [s] of the last step, for which the earth pressure has still to follow
  Budget budget_;
  double min_depth_ = 0;
  long updates_ = 0;
};

}  // namespace couloir
