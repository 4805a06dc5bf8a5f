#include "continuum/scheme/control_box.hpp"

namespace couloir {
namespace {

template <class F>
void for_cells(const BoxPart& part, const Block& b, F&& f) {
  for (int j = part.j0; j < part.j1; ++j) {
    for (int i = part.i0; i < part.i1; ++i) f(b.at(i, j), i);
  }
}

}  // namespace

void count_box_faces(const std::vector<BoxPart>& parts, const Block& b, const Axis& axis, double share, Tally& t) {
  const FaceFluxes& f = *axis.fluxes;
  const int normal = axis.along_x ? 0 : 1, low = axis.along_x ? 0 : 2;
  const double in = share * axis.face_length;
  for (const BoxPart& part : parts) {
    BoxTerms& terms = t.boxes[part.box];
    const int n = axis.along_x ? part.j1 - part.j0 : part.i1 - part.i0;
    for (int k = 0; k < n; ++k) {
      const int first = axis.along_x ? b.at(part.i0, part.j0 + k) : b.at(part.i0 + k, part.j0);
      const int end = axis.along_x ? b.at(part.i1, part.j0 + k) : b.at(part.i0 + k, part.j1);
      if (part.end[low]) {  // each side of a face as the cell inside sees it
        terms.faces[normal] += in * f.normal_above[first];
        terms.faces[1 - normal] += in * f.tangent[first];
      }
      if (part.end[low + 1]) {
        terms.faces[normal] -= in * f.normal_below[end];
        terms.faces[1 - normal] -= in * f.tangent[end];
      }
    }
  }
}

void count_box_weight(const std::vector<BoxPart>& parts, const Block& b, const BlockState& s, double share, Tally& t) {
  for (const BoxPart& part : parts) {
    double sum = 0;
    for_cells(part, b, [&](int c, int i) { sum += s.now.h[c] * b.drive[i + Block::ghosts]; });
    t.boxes[part.box].weight += share * b.grid.dx * b.grid.dy * sum;
  }
}

void count_box_friction(const std::vector<BoxPart>& parts, const Block& b, const Scratch& w, Tally& t) {
  for (const BoxPart& part : parts) {
    std::array<double, 2> sum{};
    for_cells(part, b, [&](int c, int) { sum[0] += w.lost_x[c], sum[1] += w.lost_y[c]; });
    for (int k : {0, 1}) t.boxes[part.box].friction[k] += b.grid.dx * b.grid.dy * sum[k];
  }
}

}  // namespace couloir
