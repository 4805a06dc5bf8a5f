#include "continuum/solver_impl.hpp"

namespace couloir {

void Solver::Impl::lay_zones() {
  mark_open();
  lay_rims();
  rate.reset();
}

void Solver::Impl::mark_open() {
  for_cells([&](int k, int c) {
    const Block& b = mesh.blocks()[k];
    const auto [i, j] = b.local(c);
    states[k].open[c] = zones.contains((b.i0 + i) >> b.level, (b.j0 + j) >> b.level) ? 0.0 : 1.0;
  });
  for (std::size_t k = 0; k < states.size(); ++k) ghosts->fill_open(states, static_cast<int>(k));
}

// Every block meets the rim faces between its own cells and their neighbours, also where the outer cell is another block's. Finer
// cells have several faces on one of the rim's.
void Solver::Impl::lay_rims() {
  for (BlockFaces& f : faces) f.rim.clear();
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Block& b = mesh.blocks()[n];
    const int parts = 1 << b.level;
    for (int id = 0; id < zones.ids(); ++id) {
      const CoveredZone& zone = zones.zone(id);
      const CellBox& box = zone.box();
      const auto add = [&](SideName side, bool along_x, int gi, int gj, int k) {
        for (int part = 0; part < parts; ++part) {
          const int i = gi * parts + (along_x ? 0 : part) - b.i0, j = gj * parts + (along_x ? part : 0) - b.j0;
          const bool met = i >= 0 && j >= 0 && i < b.nx + (along_x ? 1 : 0) && j < b.ny + (along_x ? 0 : 1);
          if (met && zone.has_rim(side)) faces[n].rim.push_back({b.at(i, j), along_x, id, side, k, part, parts});
        }
      };
      for (int k = 0; k < box.j1 - box.j0; ++k) {
        add(SideName::upstream, true, box.i0, box.j0 + k, k);
        add(SideName::downstream, true, box.i1, box.j0 + k, k);
      }
      for (int k = 0; k < box.i1 - box.i0; ++k) {
        add(SideName::left, false, box.i0 + k, box.j0, k);
        add(SideName::right, false, box.i0 + k, box.j1, k);
      }
    }
  }
}

void Solver::Impl::count_zones(double dt) {
  zones.count(dt);
  for (int id = 0; id < zones.ids(); ++id) {
    const CoveredZone& zone = zones.zone(id);
    for (SideName side : all_sides) {
      if (!zone.has_rim(side)) continue;
      const double inward = (is_low(side) ? -dt : dt) * (is_across_x(side) ? settings.grid.dy : settings.grid.dx);
      for (int k = 0; k < zone.faces(side); ++k) {
        const FaceFlux& f = zone.actual(side, k);
        budget.mass_zone += inward * f.mass;
        budget.zone[0] += inward * f.mom_x;
        budget.zone[1] += inward * f.mom_y;
      }
    }
  }
}

}  // namespace couloir
