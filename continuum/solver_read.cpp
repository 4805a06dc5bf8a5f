// Reading a refined mesh by place.

#include <algorithm>
#include <cmath>

#include "continuum/solver_impl.hpp"

namespace couloir {

std::optional<FlowState> Solver::Impl::state_at(int level, int i, int j) const {
  const int k = mesh.block_of({level, i / settings.block, j / settings.block});
  if (k >= 0) {
    const Block& b = mesh.blocks()[k];
    const int c = b.at(i - b.i0, j - b.j0);
    const Fields& q = states[k].now;
    return FlowState{q.h[c], q.hu[c], q.hv[c]};
  }
  if (level == mesh.levels()) return std::nullopt;
  FlowState sum;
  for (int m : {0, 1}) {
    for (int n : {0, 1}) {
      const std::optional<FlowState> child = state_at(level + 1, 2 * i + n, 2 * j + m);
      if (!child) return std::nullopt;
      sum.h += 0.25 * child->h, sum.hu += 0.25 * child->hu, sum.hv += 0.25 * child->hv;
    }
  }
  return sum;
}

void Solver::for_finest(double x0, double x1, double y0, double y1, const std::function<void(const Sample&)>& f) const {
  if (impl_->settings.refinement.empty()) return FlowModel::for_finest(x0, x1, y0, y1, f);
  impl_->sync();
  for (std::size_t k = 0; k < impl_->states.size(); ++k) {
    const Block& b = impl_->mesh.blocks()[k];
    const Fields& q = impl_->states[k].now;
    const CellBox box = centres_in(b.grid, x0, x1, y0, y1);
    const auto first = [](int at, int n, int from) { return std::max(std::clamp(at, 0, n - 1) - from, 0); };
    const auto last = [](int at, int n, int from, int size) { return std::min(std::clamp(at - 1, 0, n - 1) - from, size - 1); };
    for (int j = first(box.j0, b.grid.ny, b.j0); j <= last(box.j1, b.grid.ny, b.j0, b.ny); ++j) {
      for (int i = first(box.i0, b.grid.nx, b.i0); i <= last(box.i1, b.grid.nx, b.i0, b.nx); ++i) {
        const int c = b.at(i, j);
        f({b.grid.x(b.i0 + i), b.grid.y(b.j0 + j), {q.h[c], q.hu[c], q.hv[c]}});
      }
    }
  }
}

// On the finest grid on which the four cells about the point are there, themselves or as means of finer ones.
FlowState Solver::interpolated(double x, double y) const {
  const Impl& m = *impl_;
  impl_->sync();
  const Grid& base = grid();
  const auto cell = [](double at, double origin, double size, int n) {
    return std::clamp(static_cast<int>(std::floor((at - origin) / size)), 0, n - 1);
  };
  const Mesh::Patch patch = m.mesh.over(cell(x, base.x0, base.dx, base.nx), cell(y, base.y0, base.dy, base.ny));
  for (int level = m.mesh.blocks()[patch.block].level; level > 0; --level) {
    const Grid g = base.refined(level);
    const double px = std::clamp((x - g.x0) / g.dx - 0.5, 0.0, double(g.nx - 1)),
                 py = std::clamp((y - g.y0) / g.dy - 0.5, 0.0, double(g.ny - 1));
    const int i = std::min(static_cast<int>(px), g.nx - 2), j = std::min(static_cast<int>(py), g.ny - 2);
    FlowState sum;
    bool whole = true;
    for (int row : {0, 1}) {
      for (int column : {0, 1}) {
        const std::optional<FlowState> q = m.state_at(level, i + column, j + row);
        whole = whole && q;
        if (!whole) continue;
        const double weight = (column == 0 ? 1 - (px - i) : px - i) * (row == 0 ? 1 - (py - j) : py - j);
        sum.h += weight * q->h, sum.hu += weight * q->hu, sum.hv += weight * q->hv;
      }
    }
    if (whole) return sum;
  }
  return FlowModel::interpolated(x, y);
}

}  // namespace couloir
