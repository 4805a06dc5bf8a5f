#include "continuum/boundary/covered_zone.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace couloir {
CoveredZone::CoveredZone(const CellBox& box, const Grid& grid) : box_(box), dx_(grid.dx), dy_(grid.dy) {
  if (box.empty() || box.i0 < 0 || box.j0 < 0 || box.i1 > grid.nx || box.j1 > grid.ny) {
    throw std::invalid_argument("The covered zone must hold at least one cell and lie inside the grid; move or shrink the zone.");
  }
  const bool inside[] = {box.i0 > 0, box.i1<grid.nx, box.j0> 0, box.j1 < grid.ny};
  for (SideName side : all_sides) {
    Rim& r = rim(side);
    const int n = is_across_x(side) ? box.j1 - box.j0 : box.i1 - box.i0;
    r.inside_domain = inside[static_cast<int>(side)];
    r.imposed.resize(n), r.actual.resize(n), r.passed.resize(n), r.weights.resize(n, {1.0});
  }
}

CoveredZone::Neighbour CoveredZone::neighbour(SideName side, int k) const {
  switch (side) {
    case SideName::upstream:
      return {box_.i0 - 1, box_.j0 + k};
    case SideName::downstream:
      return {box_.i1, box_.j0 + k};
    case SideName::left:
      return {box_.i0 + k, box_.j0 - 1};
    case SideName::right:
      break;
  }
  return {box_.i0 + k, box_.j1};
}

void CoveredZone::impose(SideName side, int k, const FaceFlux& flux) {
  rim(side).imposed.at(k) = flux;
}
const FaceFlux& CoveredZone::imposed(SideName side, int k) const {
  return rim(side).imposed.at(k);
}
const FaceFlux& CoveredZone::passed(SideName side, int k) const {
  return rim(side).passed.at(k);
}
const FaceFlux& CoveredZone::actual(SideName side, int k) const {
  return rim(side).actual[k];
}
FaceFlux CoveredZone::actual(SideName side, int k, int part, int parts) const {
  const Rim& r = rim(side);
  const std::vector<double>& weights = r.weights[k];
  const int n = static_cast<int>(weights.size()), first = part * n / parts, past = std::max(first + 1, (part + 1) * n / parts);
  const double weight = std::accumulate(weights.begin() + first, weights.begin() + past, 0.0) / (past - first);
  const FaceFlux& f = r.actual[k];
  return {weight * f.mass, weight * f.mom_x, weight * f.mom_y};
}
void CoveredZone::set_passed(SideName side, int k, const FaceFlux& flux) {
  rim(side).passed.at(k) = flux;
}
void CoveredZone::reset_passed() {
  for (Rim& r : rims_) r.passed.assign(r.passed.size(), {});
}

void CoveredZone::limit(double dt, double share, const StatesAlong& outside,
                        const std::function<double(SideName, int i, int j)>& also_drawn) {
  for (SideName side : all_sides) {
    Rim& r = rim(side);
    for (std::size_t k = 0; r.inside_domain && k < r.imposed.size(); ++k) {
      const FaceFlux& f = r.imposed[k];
      const Neighbour n = neighbour(side, static_cast<int>(k));
      const double own = dt * (is_low(side) ? f.mass : -f.mass);
      const double taken = own > 0 ? own + dt * also_drawn(side, n.i, n.j) : own;
      std::vector<double>& weights = r.weights[k];
      weights.clear();
      for (const FlowState& q : outside(side, n.i, n.j)) weights.push_back(q.h);
      const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(weights.size());
      for (double& w : weights) w = own >= 0 && mean > 0 ? w / mean : 1.0;
      const double most = share * mean * (is_across_x(side) ? dx_ : dy_);
      const double scale = taken > most ? most / taken : 1.0;
      r.actual[k] = {f.mass * scale, f.mom_x * scale, f.mom_y * scale};
    }
  }
}

void CoveredZone::count(double dt) {
  for (Rim& r : rims_) {
    for (std::size_t k = 0; r.inside_domain && k < r.actual.size(); ++k) {
      r.passed[k].mass += dt * r.actual[k].mass;
      r.passed[k].mom_x += dt * r.actual[k].mom_x;
      r.passed[k].mom_y += dt * r.actual[k].mom_y;
    }
  }
}

}  // namespace couloir
