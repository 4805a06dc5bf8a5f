#include "coupling/transfer/fill.hpp"

#include <cmath>
#include <stdexcept>

namespace couloir {
namespace {

struct Site {
  double x, y, z, r, mass;
  FlowState flow;
};

bool clear_of_walls(const FillBox& box, double x, double y, double r) {
  const auto [x0, x1, y0, y1] = box.walls;
  return !(x0 && x - r < box.x0) && !(x1 && x + r > box.x1) && !(y0 && y - r < box.y0) && !(y1 && y + r > box.y1);
}

// All grains of the tiled packing over the box that any flow depth could take.
std::vector<Site> sites(const FillBox& box, const std::function<FlowState(double, double)>& flow, const PackingTable& table) {
  const Packing& block = table.packing();
  std::vector<Site> out;
  const int columns = int(std::ceil((box.x1 - box.x0) / block.length)), rows = int(std::ceil((box.y1 - box.y0) / block.width));
  for (int c = 0; c < columns; ++c)
    for (int row = 0; row < rows; ++row)
      for (const auto& g : block.grains) {
        const double x = box.x0 + c * block.length + g.x, y = box.y0 + row * block.width + g.y;
        if (x >= box.x1 || y >= box.y1 || !clear_of_walls(box, x, y, g.r)) continue;
        const FlowState q = flow(x, y);
        if (q.h > 0) out.push_back({x, y, std::max(g.z, g.r), g.r, table.grain_mass(g.r), q});
      }
  return out;
}

double mass_at_scale(const std::vector<Site>& all, const PackingTable& table, double scale) {
  double sum = 0;
  for (const Site& s : all)
    if (s.z <= table.cut(scale * table.bulk_density() * s.flow.h)) sum += s.mass;
  return sum;
}

}  // namespace

std::vector<NewGrain> fill(const FillBox& box, const std::function<FlowState(double, double)>& flow, double mass,
                           const PackingTable& table, const ReferenceSurface& surface, std::int64_t& next_id) {
  const auto all = sites(box, flow, table);
  double scale = 1;
  if (mass > 0 && !all.empty()) {
    double low = 0.5, high = 1.5;
    for (int k = 0; k < 60; ++k) {
      scale = 0.5 * (low + high);
      (mass_at_scale(all, table, scale) < mass ? low : high) = scale;
    }
  }
  std::vector<NewGrain> out;
  for (const Site& s : all) {
    const double wanted = scale * table.bulk_density() * s.flow.h;
    if (wanted > table.areal_mass())
      throw std::invalid_argument("the packing is not deep enough for a flow of " + std::to_string(s.flow.h) + " m");
    if (s.z > table.cut(wanted)) continue;
    const Eigen::Vector3d p = surface.to_space({s.x, s.y, s.z});
    const Eigen::Vector3d v = s.flow.hu / s.flow.h * surface.tangent(s.x) + s.flow.hv / s.flow.h * Eigen::Vector3d::UnitY();
    out.push_back({next_id++, {p.x(), p.y(), p.z()}, {v.x(), v.y(), v.z()}, s.r});
  }
  return out;
}

}  // namespace couloir
