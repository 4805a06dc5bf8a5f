// The solver's state as bytes, in one fixed order: header, counters, cells, zones, sums.

#include <stdexcept>

#include "continuum/bytes.hpp"
#include "continuum/scheme/effects.hpp"
#include "continuum/solver_impl.hpp"

namespace couloir {
namespace {

constexpr std::uint64_t signature = 0x36526c6f75636f63;  // changes with the layout

}  // namespace

std::vector<std::uint8_t> Solver::checkpoint() const {
  Impl& m = *impl_;
  m.sync();
  ByteWriter put;
  put(signature);
  put(m.settings.grid.nx), put(m.settings.grid.ny), put(static_cast<int>(m.impulse.size()));
  put(m.time), put(m.steps), put(m.cell_updates), put(m.min_depth), put(m.min_depth_met);
  put(static_cast<int>(m.mesh.leaves().size()));
  for (const Leaf& leaf : m.mesh.leaves()) put(leaf);
  for (const Impl::Level& l : m.levels) put(l.strained);
  const bool shares = with_earth_pressure(m.parameters);
  m.for_cells([&](int k, int c) {
    const BlockState& s = m.states[k];
    put(FlowState{s.now.h[c], s.now.hu[c], s.now.hv[c]});
    if (shares) put(s.passive_x[c]), put(s.passive_y[c]);
  });
  put(m.zones.ids());
  for (int id = 0; id < m.zones.ids(); ++id) put(m.zones.zone(id).box());
  for (int id = 0; id < m.zones.ids(); ++id) {
    const CoveredZone& zone = m.zones.zone(id);
    for (SideName side : all_sides) {
      for (int k = 0; k < zone.faces(side); ++k) put(zone.imposed(side, k)), put(zone.passed(side, k));
    }
  }
  for (const auto& impulse : m.impulse) put(impulse);
  put_gauges(put, m.gauges);
  put(static_cast<int>(m.boxes.size()));
  for (const Impl::ControlBox& b : m.boxes) put(b);
  put(m.budget);
  return std::move(put.bytes);
}

void Solver::restore(const std::vector<std::uint8_t>& bytes) {
  Impl& m = *impl_;
  ByteReader in(bytes);
  const bool ours = in.take<std::uint64_t>() == signature && in.take<int>() == m.settings.grid.nx &&
                    in.take<int>() == m.settings.grid.ny && in.take<int>() == static_cast<int>(m.impulse.size());
  if (!ours)
    throw std::invalid_argument(
        "The checkpoint belongs to another continuum (grid or obstacles differ); restore it with its own scene.");
  m.time = in.take<double>();
  m.steps = in.take<std::int64_t>();
  m.cell_updates = in.take<std::int64_t>();
  m.min_depth = in.take<double>();
  m.min_depth_met = in.take<bool>();
  std::vector<Leaf> leaves(in.take<int>());
  for (Leaf& leaf : leaves) leaf = in.take<Leaf>();
  m.take_leaves(leaves);
  for (Impl::Level& l : m.levels) l.strained = in.take<double>();
  for (BlockState& s : m.states) s.wet = 0;
  const bool shares = with_earth_pressure(m.parameters);
  m.for_cells([&](int k, int c) {
    BlockState& s = m.states[k];
    m.put_in(k, c, in.take<FlowState>());
    if (shares) s.passive_x[c] = in.take<double>(), s.passive_y[c] = in.take<double>();
  });
  std::vector<CellBox> covered(in.take<int>());
  for (CellBox& box : covered) box = in.take<CellBox>();
  m.zones.become(covered);
  m.lay_zones();
  for (int id = 0; id < m.zones.ids(); ++id) {
    CoveredZone& zone = m.zones.zone(id);
    for (SideName side : all_sides) {
      for (int k = 0; k < zone.faces(side); ++k) {
        zone.impose(side, k, in.take<FaceFlux>());
        zone.set_passed(side, k, in.take<FaceFlux>());
      }
    }
  }
  for (auto& impulse : m.impulse) impulse = in.take<std::array<double, 2>>();
  m.gauges = take_gauges(in);
  for (BlockFaces& f : m.faces) f.gauges.clear();
  for (std::size_t g = 0; g < m.gauges.size(); ++g) m.lay_gauge(static_cast<int>(g));
  const int boxes = in.take<int>();
  m.boxes.clear();
  for (BlockFaces& f : m.faces) f.boxes.clear();
  for (int b = 0; b < boxes; ++b) {
    m.boxes.push_back(in.take<Impl::ControlBox>());
    m.lay_box(b);
  }
  m.budget = in.take<Budget>();
  if (!in.done()) throw std::invalid_argument("The continuum's checkpoint is longer than its state; restore an earlier one.");
}

}  // namespace couloir
