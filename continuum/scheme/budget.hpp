#pragma once
// Momentum and mass that entered (+) the active cells since the last reset, by cause. Depth-averaged units: times the bulk
// density they are kg and N s. Vector entries are (x, y) in reference coordinates.

#include <array>

namespace couloir {

struct Budget {
  double mass_boundary = 0;         // [m3] through the domain's sides
  double mass_inflow = 0;           // [m3] its part through inflow sides
  double mass_zone = 0;             // [m3] through the faces of the covered zones
  double mass_added = 0;            // [m3] from above, by Solver::add
  double mass_copied = 0;           // [m3] by copying refined patches into the grids below them
  double mass_clipped = 0;          // [m3] created by removing negative depths; 0 unless something is wrong
  std::array<double, 2> gravity{};  // [m4/s] downslope weight and bed slope
  std::array<double, 2> friction{};
  std::array<double, 2> boundary{};              // momentum and pressure through the domain's sides
  std::array<std::array<double, 2>, 4> sides{};  // the same by SideName; what a wall gives to the flow
  std::array<double, 2> zone{};                  // through the faces of the covered zones
  std::array<double, 2> added{};                 // from above
  std::array<double, 2> obstacles{};             // from obstacles, steps and elevation, all together
  std::array<double, 2> copied{};                // by copying refined patches
  std::array<double, 2> cutoff{};                // momentum dropped where the depth is below dry_depth

  void add(const Budget& b) {
    mass_boundary += b.mass_boundary;
    mass_inflow += b.mass_inflow;
    mass_zone += b.mass_zone;
    mass_added += b.mass_added;
    mass_copied += b.mass_copied;
    mass_clipped += b.mass_clipped;
    for (int k : {0, 1}) {
      gravity[k] += b.gravity[k];
      friction[k] += b.friction[k];
      boundary[k] += b.boundary[k];
      for (int side = 0; side < 4; ++side) sides[side][k] += b.sides[side][k];
      zone[k] += b.zone[k];
      added[k] += b.added[k];
      obstacles[k] += b.obstacles[k];
      copied[k] += b.copied[k];
      cutoff[k] += b.cutoff[k];
    }
  }
};

}  // namespace couloir
