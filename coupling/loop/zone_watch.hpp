#pragma once
// Whether a zone should grow, shrink, rest or end: looked at once a window.
//
//   grow     a side, by a step: the flow comes in there faster than its waves, and `watched` inside of the face, over a
//            quarter of what comes in, the grains are slower than half of it: a jump or a dead zone is near. For 5 windows; then
//            not again for 20.
//   shrink   a side that has grown, by a step: in its outermost step, and `watched` further, the grains are within 15 % as fast
//            as the flow that comes in, or there are none. For 100 ms.
//   rest     no flow comes in (Zone::flow_comes), and all but two of a thousand grains that count are slower than 2 % of
//            sqrt(g d). For 50 ms.
//   empty    no flow comes in, and no grain that counts is left. For 50 ms.
//
// d grain diameter; watched = 10 d.

#include <array>
#include <optional>
#include <string>

#include "coupling/checkpoint/archive.hpp"
#include "coupling/plan/zone_growth.hpp"
#include "coupling/transfer/zone.hpp"

namespace couloir {

class ZoneWatch {
 public:
  // diameter [m], gravity [m/s2].
  ZoneWatch(const ZoneLines& lines, double diameter, double gravity)
      : lines_(lines), diameter_(diameter), gravity_(gravity), at_{lines.at_x, lines.at_x + 1, lines.at_y, lines.at_y + 1} {}

  CellBox box() const { return {lines_.x[at_[0]], lines_.x[at_[1]], lines_.y[at_[2]], lines_.y[at_[3]]}; }
  CellBox widest() const { return {lines_.x.front(), lines_.x.back(), lines_.y.front(), lines_.y.back()}; }

  struct Move {
    SideName side;
    bool grows;
    std::string reason;  // with its numbers
  };
  // After a window of `length` [s].
  std::optional<Move> look(const Zone&, const Solver&, const Grid&, double length);
  enum class Calm { no, resting, empty };
  Calm calm(const Zone&, bool flow_comes, const Grains&, double length);
  void take(const Move&);  // box() is then the new one

  void state(Archive& a) { a(at_, disturbed_, undisturbed_, pause_, resting_, empty_); }

 private:
  std::optional<Move> grow(const Zone&, const Solver&, const Grid&);
  std::optional<Move> shrink(const Zone&, const Solver&, const Grid&, double length);
  static int number(SideName side) { return static_cast<int>(side); }

  ZoneLines lines_;
  double diameter_, gravity_;
  std::array<int, 4> at_;                // lines on which the sides lie: upstream, downstream, left, right
  std::array<int, 4> disturbed_{};       // windows
  std::array<double, 4> undisturbed_{};  // [s]
  int pause_ = 0;                        // windows until the next growth
  double resting_ = 0, empty_ = 0;       // [s]
};

}  // namespace couloir
