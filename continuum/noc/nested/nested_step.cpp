// The order of a step on nested grids (section 5.1.2).

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "continuum/errors.hpp"
#include "continuum/noc/nested/nested_impl.hpp"

namespace couloir {

NestedNoc::Impl::Impl(const SolverSettings& s, const ReferenceSurface& surface, const NocBed& bed, const NocSettings& own)
    : obstacles(static_cast<int>(bed.obstacles.size())) {
  if (s.refinement.adaptive.levels > 0) {
    throw std::invalid_argument(
        "The scheme noc refines where it is told to, not where the flow asks for it; give boxes, or use central_upwind.");
  }
  const auto periodic = [&](int side) { return s.sides[side].kind == Side::Kind::periodic; };
  const auto places = noc::lay_patches(s.grid, s.refinement, periodic(0), periodic(2), noc::rim_width(s.limiter) / 2);
  nests.reserve(places.size() + 1);
  nests.emplace_back(s, surface, bed, own, noc::PatchPlace{0, -1, {}}, nullptr);
  for (const noc::PatchPlace& p : places) {
    const int parent = p.parent + 1;
    nests[parent].children.push_back(static_cast<int>(nests.size()));
    nests.emplace_back(s, surface, bed, own, p, &nests[parent]);
    nests.back().parent = parent;
  }
  for (Nest& n : nests) {
    std::vector<CellBox> left;
    for (int child : n.children) left.push_back(nests[child].foot);
    n.solver.count_forces_in(n.inside, left);
  }
}

double NestedNoc::Impl::stable_dt() const {
  double least = base().stable_dt();
  for (const Nest& n : nests) least = std::min(least, std::ldexp(n.solver.stable_dt(), n.level));
  return least;
}

void NestedNoc::Impl::advance(int nest, double dt) {
  Nest& n = nests[nest];
  const double start = n.solver.time();
  n.solver.step(dt);  // which may take it shorter
  timer.apart(StepPart::levels, [&] {
    for (int child : n.children) nests[child].read_end(n);
  });
  for (int child : n.children) follow(child, start, n.solver.time());
  timer.apart(StepPart::levels, [&] {
    for (int child : n.children) copy_up(child);
    fill_rims(nest);
  });
}

// Two steps, or as many more as a flow that has become faster takes.
void NestedNoc::Impl::follow(int child, double start, double end) {
  constexpr double least_step = 1e-9;  // of the parent's
  Nest& n = nests[child];
  const double span = end - start;
  while (n.solver.time() < end) {
    if (n.solver.time() > start) n.fill_rim((n.solver.time() - start) / span);
    const double left = end - n.solver.time(), stable = n.solver.stable_dt();
    if (stable < least_step * span) {
      throw NumericsError("The flow on a refined patch has become so fast (" + std::to_string(n.solver.max_speed()) +
                          " m/s) that its steps no longer get anywhere at t = " + std::to_string(n.solver.time()) +
                          " s; check what was released or comes in, or refine less.");
    }
    if (left <= std::min(stable, 0.5 * span * (1 + 1e-9))) {
      advance(child, left);
      if (end - n.solver.time() < 1e-9 * span) set_time(child, end);  // it may have been cut shorter
    } else {
      advance(child, std::min({stable, 0.5 * span, 0.5 * left}));
    }
  }
}

void NestedNoc::Impl::copy_up(int child) {
  const Nest& n = nests[child];
  nests[n.parent].solver.replace(n.foot, [&](int i, int j) { return n.mean_over(i, j); });
}

void NestedNoc::Impl::fill_rims(int nest) {
  for (int child : nests[nest].children) {
    nests[child].read_start(nests[nest]);
    nests[child].fill_rim(0);
  }
}

void NestedNoc::Impl::set_time(int nest, double t) {
  nests[nest].solver.set_time(t);
  for (int child : nests[nest].children) set_time(child, t);
}

}  // namespace couloir
