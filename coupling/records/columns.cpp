#include "coupling/records/columns.hpp"

namespace couloir {

const std::vector<WindowColumn>& window_columns() {
  using W = const WindowReport&;
  static const std::vector<WindowColumn> columns{
      {"time", "s", "end of the window", [](W w) { return w.time; }},
      {"length", "s", "length of the window", [](W w) { return w.length; }},
      {"index", "1", "number of the window", [](W w) { return double(w.index); }},
      {"mass_initial", "kg", "released mass", [](W w) { return w.mass.initial; }},
      {"mass_continuum", "kg", "mass in the continuum's own cells", [](W w) { return w.mass.continuum; }},
      {"mass_grains", "kg", "mass of the grains in the engine", [](W w) { return w.mass.grains; }},
      {"mass_faces", "kg", "remainder on the zone's faces, not yet a whole grain", [](W w) { return w.mass.faces; }},
      {"mass_airborne", "kg", "mass that left the zone above the flow and has not landed", [](W w) { return w.mass.airborne; }},
      {"mass_left_domain", "kg", "mass that left the domain since the start", [](W w) { return w.mass.left_domain; }},
      {"mass_entered", "kg", "mass that entered through inflow sides since the start", [](W w) { return w.mass.entered; }},
      {"mass_copied", "kg", "mass won by copying between refined grids since the start", [](W w) { return w.mass.copied; }},
      {"mass_relative_error", "1", "|total - initial| / max(initial, entered)", [](W w) { return w.mass.relative_error(); }},
      {"momentum_storage", "N s", "change of momentum along the slope in the window", [](W w) { return w.momentum.storage; }},
      {"momentum_gravity", "N s", "by the downslope weight", [](W w) { return w.momentum.gravity; }},
      {"momentum_bed", "N s", "by the bed: friction and pressure", [](W w) { return w.momentum.bed; }},
      {"momentum_obstacles", "N s", "by the obstacles", [](W w) { return w.momentum.obstacles; }},
      {"momentum_boundary", "N s", "through the domain's sides", [](W w) { return w.momentum.boundary; }},
      {"momentum_faces", "N s", "by the zone's faces and driven layers", [](W w) { return w.momentum.faces; }},
      {"momentum_copied", "N s", "by copying between refined grids", [](W w) { return w.momentum.copied; }},
      {"momentum_residual", "N s", "storage minus all the others", [](W w) { return w.momentum.residual; }},
      {"momentum_scale", "N s", "largest momentum met so far", [](W w) { return w.momentum.scale; }},
      {"force_together", "N", "on all obstacles along the slope, by their own forces: mean over the window",
       [](W w) { return w.force_together(); }},
      {"force_by_control_volume", "N", "the same by what the material lost: gravity, bed, sides and storage",
       [](W w) { return w.force_by_control_volume(); }},
      {"grains", "1", "grains in the engine", [](W w) { return double(w.grains); }},
      {"inserted", "1", "grains inserted since the start", [](W w) { return double(w.inserted); }},
      {"returned", "1", "grains returned to the continuum since the start", [](W w) { return double(w.returned); }},
      {"engine_steps", "1", "engine steps since the start", [](W w) { return double(w.engine_steps); }},
      {"solver_steps", "1", "continuum steps since the start", [](W w) { return double(w.solver_steps); }},
      {"cell_updates", "1", "cell updates since the start: active cells times stages",
       [](W w) { return double(w.cell_updates); }},
      {"max_overlap", "1", "largest overlap of two grains over their mean diameter", [](W w) { return w.max_overlap; }},
      {"max_speed", "m/s", "largest speed of grains and flow", [](W w) { return w.max_speed; }},
      {"min_depth", "m", "least depth met in an active cell, before any clipping", [](W w) { return w.min_depth; }},
      {"overtopped", "kg", "net mass over all obstacles since the start", [](W w) { return w.overtopped; }},
  };
  return columns;
}

}  // namespace couloir
