#pragma once
// Inside NestedNoc: the grids, the order of a step, and what is counted on several of them.

#include <array>
#include <vector>

#include "continuum/noc/nested/nest.hpp"
#include "continuum/noc/nested_noc.hpp"
#include "continuum/scheme/laps.hpp"

namespace couloir {

struct NestedNoc::Impl {
  using Nest = noc::Nest;

  // What one grid adds to a control box or gauge: on the finest grid at each place it counts, on all below it does not.
  struct Piece {
    int nest, id;
    double sign;
  };
  using Pieces = std::vector<Piece>;

  Impl(const SolverSettings&, const ReferenceSurface&, const NocBed&, const NocSettings&);

  NocSolver& base() { return nests.front().solver; }
  const NocSolver& base() const { return nests.front().solver; }

  // A step of a grid, by which its patches end at its time, copied to it, their rims filled from it.
  void advance(int nest, double dt);
  void follow(int child, double start, double end);
  void copy_up(int child);
  void fill_rims(int nest);
  double stable_dt() const;
  void set_time(int nest, double t);

  void find_pieces(int nest, const CellBox&, Pieces&);                          // of a control box
  void find_pieces(int nest, int i, int j0, int j1, Pieces&, double sign = 1);  // of a gauge
  std::array<double, 2> push(int obstacle) const;
  std::array<double, 2> push() const;  // on all obstacles
  void keep_books();
  void visit(int nest, const CellBox& box, const std::function<void(const Sample&)>&) const;

  std::vector<Nest> nests;  // the base grid, then the patches, parents first
  int obstacles;
  std::vector<Pieces> boxes, gauges;
  Budget budget;
  std::array<double, 2> pushed_before{};  // at the last reset of the budget
  StepTimer timer;                        // of what goes between the grids
  double drift_before = 0;                // [m3] copied until then
};

}  // namespace couloir
