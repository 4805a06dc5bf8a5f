#pragma once
// A body of grains at rest or in uniform motion, cut from a settled packing so that it has a given depth everywhere.

#include <array>
#include <functional>
#include <vector>

#include "continuum/solver.hpp"
#include "coupling/transfer/packing_table.hpp"

namespace couloir {

struct FillBox {
  double x0, x1, y0, y1;        // [m] reference coordinates
  std::array<bool, 4> walls{};  // at x0, x1, y0, y1: no grain reaches over them
};

// Grains whose centres lie in the box and below the height that holds the flow's mass at their place; ids from next_id. Along a
// wall the packing's grains that would overlap it are left out.
// `mass` [kg] > 0: the depth is scaled (a few per mille, by d / width between walls) until the grains weigh that, to a grain; 0:
// as it comes. Throws std::invalid_argument where the depth exceeds the packing's.
std::vector<NewGrain> fill(const FillBox&, const std::function<FlowState(double x, double y)>& flow, double mass,
                           const PackingTable&, const ReferenceSurface&, std::int64_t& next_id);

}  // namespace couloir
