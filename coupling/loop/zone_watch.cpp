#include "coupling/loop/zone_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace couloir {
namespace {

constexpr double watched = 10;              // [d] inside of a face
constexpr double slow = 0.5, share = 0.25;  // of the velocity outside, of what comes in
constexpr double alike = 0.15;              // of the velocity outside
constexpr int windows_to_grow = 5, windows_between = 20;
constexpr double to_shrink = 0.1, to_rest = 0.05;  // [s]
constexpr double at_rest = 0.02;                   // [sqrt(g d)]
constexpr double stragglers = 0.002;               // of the grains

int cells_in(double length, double step) {
  return std::max(1, int(std::ceil(length / step - 1e-9)));
}

}  // namespace

std::optional<ZoneWatch::Move> ZoneWatch::look(const Zone& zone, const Solver& solver, const Grid& grid, double length) {
  if (lines_.x.size() + lines_.y.size() == 4) return {};
  if (auto move = grow(zone, solver, grid)) return move;
  return shrink(zone, solver, grid, length);
}

std::optional<ZoneWatch::Move> ZoneWatch::grow(const Zone& zone, const Solver& solver, const Grid& grid) {
  pause_ = std::max(0, pause_ - 1);
  std::optional<Move> move;
  for (const RimFace& face : zone.rim().faces()) {
    const int side = number(face.side), outer = side % 2 == 0 ? at_[side] - 1 : at_[side] + 1;
    const int lines = int((side < 2 ? lines_.x : lines_.y).size());
    if (outer < 0 || outer >= lines) continue;
    const int in = cells_in(watched * diameter_, face.axis() == 0 ? grid.dx : grid.dy);
    double comes = 0, held = 0, outside = 0, inside = 0;
    for (const Zone::Look& k : zone.look(solver, face, in)) {
      if (k.froude < 1 || k.depth < 0.5 * diameter_) continue;
      const double flux = k.depth * k.outside;
      comes += flux;
      if (k.inside < slow * k.outside) held += flux;
      outside += flux * k.outside;
      inside += flux * k.inside;
    }
    disturbed_[side] = comes > 0 && held > share * comes ? disturbed_[side] + 1 : 0;
    if (move || pause_ > 0 || disturbed_[side] < windows_to_grow) continue;
    move = {face.side, true,
            fmt::format("{:.0f} mm inside of its face the grains move in at {:.3g} m/s where {:.3g} m/s come, and at less than "
                        "half of it over {:.0f} % of the inflow",
                        watched * diameter_ * 1e3, inside / comes, outside / comes, 100 * held / comes)};
  }
  return move;
}

std::optional<ZoneWatch::Move> ZoneWatch::shrink(const Zone& zone, const Solver& solver, const Grid& grid, double length) {
  std::optional<Move> move;
  for (const RimFace& face : zone.rim().faces()) {
    const int side = number(face.side);
    const int planned = std::array{lines_.at_x, lines_.at_x + 1, lines_.at_y, lines_.at_y + 1}[side];
    if (at_[side] == planned) continue;
    const auto& lines = side < 2 ? lines_.x : lines_.y;
    const int inner = side % 2 == 0 ? at_[side] + 1 : at_[side] - 1, step = std::abs(lines[inner] - lines[at_[side]]);
    const int deep = step + cells_in(watched * diameter_, face.axis() == 0 ? grid.dx : grid.dy);
    bool calm = true;
    for (int in = 0; in <= deep && calm; in += std::max(1, deep / 8))
      for (const Zone::Look& k : zone.look(solver, face, in))
        calm = calm && std::abs(k.inside - k.outside) <= alike * std::abs(k.outside) && (k.outside == 0 || k.froude > 1);
    undisturbed_[side] = calm ? undisturbed_[side] + length : 0;
    if (move || undisturbed_[side] < to_shrink) continue;
    move = {face.side, false,
            fmt::format("for {:.0f} ms its outermost {:.0f} mm have held no grains, or grains as fast as the flow that comes in",
                        to_shrink * 1e3, step * (face.axis() == 0 ? grid.dx : grid.dy) * 1e3)};
  }
  return move;
}

void ZoneWatch::take(const Move& move) {
  const int side = number(move.side);
  at_[side] += (side % 2 == 0) == move.grows ? -1 : 1;
  disturbed_ = {};
  undisturbed_ = {};
  pause_ = windows_between;
}

ZoneWatch::Calm ZoneWatch::calm(const Zone& zone, bool flow_comes, const Grains& g, double length) {
  const double limit = at_rest * std::sqrt(gravity_ * diameter_);
  long counted = 0, moving = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (!zone.is_counted(g.id[i])) continue;
    ++counted;
    if (g.vx[i] * g.vx[i] + g.vy[i] * g.vy[i] + g.vz[i] * g.vz[i] > limit * limit) ++moving;
  }
  const bool quiet = !flow_comes;
  resting_ = quiet && counted > 0 && double(moving) <= stragglers * double(counted) ? resting_ + length : 0;
  empty_ = quiet && counted == 0 ? empty_ + length : 0;
  return resting_ >= to_rest ? Calm::resting : empty_ >= to_rest ? Calm::empty : Calm::no;
}

}  // namespace couloir
