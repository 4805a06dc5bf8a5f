#pragma once
// What the points of a lattice hold in a half step, and how they will share it out.

#include <array>
#include <vector>

#include "continuum/flow/flow_state.hpp"

namespace couloir::noc {

struct Point {
  FlowState q;     // at t^n
  FlowState x, y;  // slopes times a quarter of the spacing, (3.5)
  FlowState half;  // at t^{n+1/2}, (3.8)
  FlowState tilt_x,
      tilt_y;        // what an upper quadrant gets beside its quarter: x/4 + dt/(2 dx) f, (3.6), (3.7); a lower one gives it
  double reach = 0;  // [m/s] no flow that starts here is faster at the end of the half step
};

// Arrays of the same length in one piece. They begin an odd number of cache lines apart: inner loops read some forty of them at
// the same index, which would else compete for the same few places of the cache.
class Arrays {
 public:
  Arrays(int count, int length) : stride_((length + line - 1) / line * line) {
    while (stride_ / line % page != apart) stride_ += line;
    values_.assign(static_cast<std::size_t>(count) * stride_, 0.0);
  }
  Arrays(const Arrays&) = delete;
  Arrays& operator=(const Arrays&) = delete;
  double* next() { return values_.data() + used_++ * stride_; }

 private:
  static constexpr std::size_t line = 8, page = 64, apart = 3;  // doubles; lines; lines
  std::size_t stride_, used_ = 0;
  std::vector<double> values_;
};

struct Three {
  double *h, *hu, *hv;
  explicit Three(Arrays& a) : h(a.next()), hu(a.next()), hv(a.next()) {}
  [[gnu::always_inline]] FlowState at(int c) const { return {h[c], hu[c], hv[c]}; }
};

// Where the points of a lattice are. To be copied before an inner loop, so that the places stay in registers.
struct Points {
  Three q, x, y, half, tilt_x, tilt_y;
  double* reach;
  static constexpr int arrays = 19;

  explicit Points(Arrays& a) : q(a), x(a), y(a), half(a), tilt_x(a), tilt_y(a), reach(a.next()) {}
  [[gnu::always_inline]] Point at(int c) const {
    return {q.at(c), x.at(c), y.at(c), half.at(c), tilt_x.at(c), tilt_y.at(c), reach[c]};
  }
  std::array<Three, 6> threes() const { return {q, x, y, half, tilt_x, tilt_y}; }
};

}  // namespace couloir::noc
