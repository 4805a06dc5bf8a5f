#pragma once
// The rim of the zone: its faces, their segments, and where a grain stands with respect to them.
//
//        left (y low)
//      +--------------+          A face exists on each side of the zone that does not coincide with a side of the domain.
//  up  |     zone     | down     Along a face, cells are counted from the low end; `cells_per_segment` of them make a segment,
//      +--------------+          which shares one raft (grain_engine.hpp).
//        right (y high)

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "continuum/solver.hpp"
#include "coupling/engine/grain_engine.hpp"

namespace couloir {

struct RimFace {
  SideName side;
  int cells = 0;          // along the face
  double cell_width = 0;  // [m] along the face
  int cells_per_segment = 1;
  int segments = 0;
  std::array<bool, 2> walls{};  // whether a wall of the domain stands at its low end, at its high end
  bool slides = false;          // both ends lie within the domain or at an open side: its driven layer may move along it
  DriveFace drive;              // the same face for the engine
  double from_anchor = 0;       // [m] from the anchor of the settings to the face's low end, along the face
  int axis() const { return side == SideName::upstream || side == SideName::downstream ? 0 : 1; }  // normal along x or y
  double sign() const { return side == SideName::upstream || side == SideName::left ? 1 : -1; }    // of the inward normal
  int segment_of_cell(int k) const { return k / cells_per_segment; }
  std::pair<int, int> cells_of_segment(int s) const {  // first, past the last
    return {s * cells_per_segment, std::min(cells, (s + 1) * cells_per_segment)};
  }
  std::pair<double, double> reach_of_segment(int s) const {  // [m] along the face
    const auto [first, past] = cells_of_segment(s);
    return {first * cell_width, past * cell_width};
  }
  double extent() const { return cells * cell_width; }  // [m]
  double distance(const Vec& p) const;                  // [m] along the inward normal, positive in the zone
  double along(const Vec& p) const;                     // [m] from the face's low end, on the reference surface
  int cell_at(double along) const;                      // clamped to the face
  int segment_at(const Vec& p) const { return segment_of_cell(cell_at(along(p))); }
  Vec place(double distance, double along, double height) const;  // in space; `height` [m] above the reference surface
  Vec direction(double along) const;                              // unit, along the face there

  const ReferenceSurface* surface = nullptr;
  double x0 = 0, y0 = 0;  // [m] reference coordinates of the low end
};

struct RimSettings {
  double diameter = 0;          // [m]
  double layer = 2;             // depth of the driven layer [d]
  double buffer = 12;           // how far grains that left live on outside as support for those inside [d]
  double short_buffer = 4;      // the same where the outflow is fast [d]
  double strip = 3;             // the buffer's last part, in which they move with the flow outside [d]
  double segment = 16;          // least width of a segment [d]
  std::array<bool, 4> walls{};  // sides of the domain that are walls: upstream, downstream, left, right
  std::array<bool, 4> open{};   // that material passes
  // [m] reference coordinates from which conveyors lay their blocks, so that a face that is moved goes on with the same grains.
  std::optional<std::array<double, 2>> anchor;  // none: the zone's low corner
};

class Rim {
 public:
  // Keeps the surface.
  Rim(const Grid&, const CellBox& zone, const ReferenceSurface&, const RimSettings&);

  const std::vector<RimFace>& faces() const { return faces_; }
  const RimSettings& settings() const { return settings_; }
  double layer() const { return settings_.layer * settings_.diameter; }                // [m]
  double buffer() const { return settings_.buffer * settings_.diameter; }              // [m]
  double short_buffer() const { return settings_.short_buffer * settings_.diameter; }  // [m]

  // The cell outside of the rim that face cell k borders on.
  std::pair<int, int> outside_cell(const RimFace&, int k) const;
  std::pair<int, int> inside_cell(const RimFace&, int k) const;

 private:
  CellBox zone_;
  RimSettings settings_;
  std::vector<RimFace> faces_;
};

}  // namespace couloir
