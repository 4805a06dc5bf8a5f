#include "continuum/boundary/covered_zones.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace couloir {
namespace {

std::string cells(const CellBox& b) {
  std::ostringstream text;
  text << "cells [" << b.i0 << ", " << b.i1 << ") x [" << b.j0 << ", " << b.j1 << ")";
  return text.str();
}

}  // namespace

CoveredZones::CoveredZones(const Grid& grid, const std::array<Side, 4>& sides)
    : grid_(grid), around_x_(sides[0].kind == Side::Kind::periodic), around_y_(sides[2].kind == Side::Kind::periodic) {}

int CoveredZones::cover(const CellBox& box) {
  zones_.push_back(checked(box, ids()));
  return ids() - 1;
}

void CoveredZones::move(int id, const CellBox& box) {
  if (zone(id).box().empty()) {
    throw std::invalid_argument("The covered zone " + std::to_string(id) + " has been uncovered; cover a box anew.");
  }
  zones_[id] = checked(box, id);
}

void CoveredZones::uncover(int id) {
  zone(id) = CoveredZone();
}

void CoveredZones::become(const std::vector<CellBox>& boxes) {
  zones_.clear();
  for (const CellBox& box : boxes) zones_.push_back(box.empty() ? CoveredZone() : checked(box, ids()));
}

const CoveredZone& CoveredZones::zone(int id) const {
  if (id >= 0 && id < ids()) return zones_[id];
  std::ostringstream text;
  text << "There is no covered zone " << id << "; " << ids() << " have been covered so far, counted from 0.";
  throw std::out_of_range(text.str());
}
CoveredZone& CoveredZones::zone(int id) {
  return const_cast<CoveredZone&>(std::as_const(*this).zone(id));
}

bool CoveredZones::contains(int i, int j) const {
  return std::ranges::any_of(zones_, [&](const CoveredZone& z) { return z.box().contains(i, j); });
}

CoveredZone CoveredZones::checked(const CellBox& box, int id) const {
  CoveredZone made(box, grid_);
  for (int other = 0; other < ids(); ++other) {
    const CellBox& there = zones_[other].box();
    if (other == id || there.empty() || !touch(box, there)) continue;
    throw std::invalid_argument("A covered zone of the " + cells(box) + " overlaps or touches zone " + std::to_string(other) +
                                " of the " + cells(there) +
                                "; leave at least one open cell between them, or cover one box around both.");
  }
  return made;
}

bool CoveredZones::touch(const CellBox& a, const CellBox& b) const {
  const auto meet = [](int a0, int a1, int b0, int b1, int period) {
    const auto shifted = [&](int by) { return a0 <= b1 + by && b0 + by <= a1; };
    return shifted(0) || (period > 0 && (shifted(period) || shifted(-period)));
  };
  return meet(a.i0, a.i1, b.i0, b.i1, around_x_ ? grid_.nx : 0) && meet(a.j0, a.j1, b.j0, b.j1, around_y_ ? grid_.ny : 0);
}

double CoveredZones::drawn(SideName side, int i, int j) const {
  const int inward = is_low(side) ? 1 : -1;
  const int zi = i + (is_across_x(side) ? inward : 0), zj = j + (is_across_x(side) ? 0 : inward);
  for (const CoveredZone& z : zones_) {
    if (!z.box().contains(zi, zj)) continue;
    return std::max(0.0, inward * z.imposed(side, is_across_x(side) ? zj - z.box().j0 : zi - z.box().i0).mass);
  }
  return 0;
}

// As no two zones touch round a corner, a cell has rims on opposite sides at most.
void CoveredZones::limit(double dt, double share, const CoveredZone::StatesAlong& outside) {
  const auto also = [&](SideName side, int i, int j) { return ids() > 1 ? drawn(opposite(side), i, j) : 0.0; };
  for (CoveredZone& z : zones_) z.limit(dt, share, outside, also);
}

void CoveredZones::count(double dt) {
  for (CoveredZone& z : zones_) z.count(dt);
}

}  // namespace couloir
