#include "continuum/noc/terrain.hpp"

#include <algorithm>
#include <cmath>

namespace couloir::noc {

Terrain::Terrain(const Grid& g, const ReferenceSurface& surface, const NocBed& bed, double gravity, bool curvature)
    : grid_(g), nx_(2 * g.nx), ny_(2 * g.ny), obstacles_(bed.obstacles.size()) {
  for (int k = 0; k < nx_; ++k) {
    const double x = g.x0 + (k + 0.5) * (0.5 * g.dx), zeta = surface.angle(x);
    weight_.push_back(gravity * std::cos(zeta));
    drive_.push_back(gravity * std::sin(zeta));
    kappa_.push_back(curvature ? surface.curvature(x) : 0.0);
    steepest_ = std::max(steepest_, std::abs(drive_.back()));
  }

  lay_bed(bed);
  lay_quadrants();
}

void Terrain::lay_bed(const NocBed& bed) {
  std::vector<NocBed::Height> parts = bed.obstacles;
  if (bed.ground) parts.push_back(bed.ground);
  level_ = parts.empty();
  if (level_) return;
  const Grid& g = grid_;
  const double qx = 0.5 * g.dx, qy = 0.5 * g.dy;
  const auto x = [&](int k) { return g.x0 + (k + 0.5) * qx; };
  const auto y = [&](int l) { return g.y0 + (l + 0.5) * qy; };
  slope_.resize(static_cast<std::size_t>(nx_) * ny_);
  if (bed.ground) ground_.resize(slope_.size());
  height_.resize(static_cast<std::size_t>(g.nx) * g.ny);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const auto& z = parts[n];
    for (int l = 0; l < ny_; ++l) {
      for (int k = 0; k < nx_; ++k) {
        const Gradient s{(z(x(k) + 0.5 * qx, y(l)) - z(x(k) - 0.5 * qx, y(l))) / qx,
                         (z(x(k), y(l) + 0.5 * qy) - z(x(k), y(l) - 0.5 * qy)) / qy};
        if (s.x == 0 && s.y == 0) continue;
        Gradient& sum = slope_[static_cast<std::size_t>(l) * nx_ + k];
        sum = {sum.x + s.x, sum.y + s.y};
        if (n < obstacles_.size()) {
          obstacles_[n].push_back({k, l, s});
        } else {
          ground_[static_cast<std::size_t>(l) * nx_ + k] = s;
        }
      }
    }
    for (int j = 0; j < g.ny; ++j) {
      for (int i = 0; i < g.nx; ++i) height_[static_cast<std::size_t>(j) * g.nx + i] += z(g.x(i), g.y(j));
    }
  }
}

void Terrain::lay_quadrants() {
  constexpr int ghosts = 2;
  const auto around = [](int i, int n) { return (i % n + n) % n; };
  for (int a : {0, 1}) {
    for (int i = -ghosts; i < grid_.nx + ghosts; ++i) {
      const int k = around(2 * i + a, nx_);
      columns_[a].weight.push_back(weight_[k]), columns_[a].drive.push_back(drive_[k]), columns_[a].kappa.push_back(kappa_[k]);
    }
  }
  const auto widen = [](CellBox& box, int i, int j) {
    box = box.empty() ? CellBox{i, i + 1, j, j + 1}
                      : CellBox{std::min(box.i0, i), std::max(box.i1, i + 1), std::min(box.j0, j), std::max(box.j1, j + 1)};
  };
  for (int k = 0; k < nx_; ++k) {
    if (kappa_[k] != 0) widen(arc_, k / 2, 0);
  }
  if (level_) return;
  for (int l = 0; l < ny_; ++l) {
    for (int k = 0; k < nx_; ++k) {
      if (slope(k, l).x != 0 || slope(k, l).y != 0) widen(relief_, k / 2, l / 2);
    }
  }
  if (relief_.i1 == grid_.nx) relief_.i0 = 0;  // a periodic domain asks for it beyond its lower end, too
  if (relief_.j1 == grid_.ny) relief_.j0 = 0;
  for (int a : {0, 1}) {
    for (int b : {0, 1}) {
      for (int j = -ghosts; j < grid_.ny + ghosts; ++j) {
        for (int i = -ghosts; i < grid_.nx + ghosts; ++i) {
          const Gradient s = slope(around(2 * i + a, nx_), around(2 * j + b, ny_));
          slopes_[a][b].x.push_back(s.x), slopes_[a][b].y.push_back(s.y);
        }
      }
    }
  }
}

double Terrain::height(int i, int j) const {
  return level_ ? 0.0 : height_[static_cast<std::size_t>(j) * grid_.nx + i];
}

}  // namespace couloir::noc
