#pragma once
// The momentum of the flow in a box of cells, term by term as a pair of half steps applies it. The box's edge runs through
// corners: what the cells inside give them, sources included, went out; what they give back to the cells inside came in.
//
//   o   o   o   o      # corner on the edge: quadrants of it inside and outside
//     #---#---#        + corner inside: gives to the box all that it gets
//   o | o | o | o
//     #---+---#
//
// The bed's push of obstacles is in none of the terms, so it is what is missing in the change of the momentum: seen from around.

#include <array>
#include <vector>

#include "continuum/mesh/grid.hpp"

namespace couloir::noc {

// Per density [m4/s]; while a row is summed, per area of a cell too.
struct BoxTerms {
  std::array<double, 2> faces{};     // in less out through the edge, pressure included
  std::array<double, 2> weight{};    // along the slope, and the push of a bed that is no obstacle
  std::array<double, 2> friction{};  // with what films and the bound of the speed took
  BoxTerms& operator+=(const BoxTerms&);
};

struct ControlBox {
  CellBox cells;
  std::array<double, 2> before{};  // momentum when it was added [m4/s]
  BoxTerms terms;
};

// Sum in the order first and last, second and last but one: mirrored rows give mirrored bits.
template <class T>
T sum_rows(const std::vector<T>& rows) {
  T sum{};
  for (std::size_t low = 0, high = rows.size(); low < high; ++low) {
    T pair = rows[low];
    if (low < --high) pair += rows[high];
    sum += pair;
  }
  return sum;
}

}  // namespace couloir::noc
