#pragma once
// What the points of a lattice hold in a half step, and how they will share it out.

#include "continuum/flow/flow_state.hpp"
#include "continuum/mesh/block.hpp"

namespace couloir::noc {

struct Point {
  FlowState q;     // at t^n
  FlowState x, y;  // slopes times a quarter of the spacing, (3.5)
  FlowState half;  // at t^{n+1/2}, (3.8)
  FlowState tilt_x,
      tilt_y;        // what an upper quadrant gets beside its quarter: x/4 + dt/(2 dx) f, (3.6), (3.7); a lower one gives it
  double reach = 0;  // [m/s] no flow that starts here is faster at the end of the half step
};

// The same of all points but for q, by index of the lattice.
struct Points {
  Fields x, y, half, tilt_x, tilt_y;
  std::vector<double> reach;

  void resize(int n) {
    for (Fields* f : {&x, &y, &half, &tilt_x, &tilt_y}) f->resize(n);
    reach.resize(n);
  }
  // All arrays, for what treats them alike.
  std::vector<std::vector<double>*> arrays() {
    std::vector<std::vector<double>*> all{&reach};
    for (Fields* f : {&x, &y, &half, &tilt_x, &tilt_y}) all.insert(all.end(), {&f->h, &f->hu, &f->hv});
    return all;
  }
};

// To read points in inner loops.
struct PointsView {
  struct Three {
    const double *h, *hu, *hv;
    explicit Three(const Fields& f) : h(f.h.data()), hu(f.hu.data()), hv(f.hv.data()) {}
    [[gnu::always_inline]] FlowState at(int c) const { return {h[c], hu[c], hv[c]}; }
  };
  Three q, x, y, half, tilt_x, tilt_y;
  const double* reach;

  PointsView(const Fields& state, const Points& p)
      : q(state), x(p.x), y(p.y), half(p.half), tilt_x(p.tilt_x), tilt_y(p.tilt_y), reach(p.reach.data()) {}
  [[gnu::always_inline]] Point at(int c) const {
    return {q.at(c), x.at(c), y.at(c), half.at(c), tilt_x.at(c), tilt_y.at(c), reach[c]};
  }
};

}  // namespace couloir::noc
