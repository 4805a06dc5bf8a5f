#pragma once
// All covered zones of a solver, by the ids that cover() gives, and what is theirs together: which cells they hold, and that
// they do not empty a cell between them. Between two zones there is at least one open cell, also round a corner and over a
// periodic side, so that no face belongs to two.
//
//   +------+ o +------+     The cell o borders on both zones: what they draw out of it together is limited.
//   | zone | o | zone |
//   +------+ o +------+

#include <array>
#include <functional>
#include <vector>

#include "continuum/boundary/covered_zone.hpp"
#include "continuum/boundary/side.hpp"
#include "continuum/mesh/grid.hpp"

namespace couloir {

class CoveredZones {
 public:
  CoveredZones(const Grid&, const std::array<Side, 4>&);

  // Throw std::invalid_argument where the box is empty, leaves the grid, or comes too near to another zone; then nothing has
  // changed. Ids count from 0 and are never given twice.
  int cover(const CellBox&);
  void move(int id, const CellBox&);  // its rim starts anew, with nothing imposed and nothing passed
  void uncover(int id);
  void become(const std::vector<CellBox>&);  // by id; an empty box: one that has been uncovered

  int ids() const { return static_cast<int>(zones_.size()); }  // given so far
  // Throw std::out_of_range where there has never been one of this id. An uncovered one has an empty box and no faces.
  const CoveredZone& zone(int id) const;
  CoveredZone& zone(int id);
  bool contains(int i, int j) const;

  // Scales each imposed flux, mass and momentum together, so that in dt all faces of a cell together take no more than this share
  // of what it holds; to be called once before both stages of a step.
  void limit(double dt, double share, const CoveredZone::StatesAlong&);
  void count(double dt);  // adds dt times the actual fluxes to what has passed

 private:
  CoveredZone checked(const CellBox&, int id) const;  // id: of the zone that it will be
  bool touch(const CellBox&, const CellBox&) const;
  double drawn(SideName, int i, int j) const;  // [m2/s] out of the cell into the zone on whose side it lies, if there is one

  Grid grid_;
  bool around_x_, around_y_;
  std::vector<CoveredZone> zones_;  // by id
};

}  // namespace couloir
