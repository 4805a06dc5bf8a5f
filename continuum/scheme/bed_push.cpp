#include "continuum/scheme/bed_push.hpp"

namespace couloir {

PushedCells::PushedCells(const Block& b) {
  for (int j = 0; j < b.ny; ++j) {
    for (int c = b.at(0, j); c < b.at(b.nx, j); ++c) {
      if (b.pushed[c] >= 0) cells.push_back(c);
    }
  }
}

void count_bed_push(const PushedCells& pushed, const Block& b, const BlockState& s, const Axis& axis, double share, Tally& t) {
  const FaceFluxes& f = *axis.fluxes;
  const int component = axis.along_x ? 0 : 1;
  for (int c : pushed.cells) {
    if (s.open[c] == 0) continue;
    const int above = c + axis.step;
    // A step face belongs to its own obstacle.
    const bool step_below = b.top[c] != b.top[c - axis.step], step_above = b.top[c] != b.top[above];
    const double jump_below = step_below ? 0 : f.normal_above[c] - f.normal[c];
    const double jump_above = step_above ? 0 : f.normal_below[above] - f.normal[above];
    const double on_flow = share * axis.face_length * (axis.source[c] * axis.spacing + jump_below - jump_above);
    t.impulse[b.pushed[c]][component] -= on_flow;
    t.budget.obstacles[component] += on_flow;
    t.budget.gravity[component] -= on_flow;  // the cells' own sum took it for the bed's
  }
}

}  // namespace couloir
