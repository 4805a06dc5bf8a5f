#include "continuum/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace couloir {
namespace {

void require(bool good, const char* sentence) {
  if (!good) throw std::invalid_argument(sentence);
}

}  // namespace

Mesh::Mesh(const Grid& grid, int edge, const ReferenceSurface& surface, const StepBed& bed, double gravity, bool curvature)
    : grid_(grid), edge_(edge) {
  require(grid.nx > 0 && grid.ny > 0, "The grid needs at least one cell in x and in y; enlarge the terrain or refine the cell.");
  require(grid.dx > 0 && grid.dy > 0, "The cells need a positive size; correct continuum.cell.");
  require(edge >= 2, "A block needs at least 2 cells along its edge; raise the block size.");
  require(bed.elevation.empty() || bed.elevation.size() == static_cast<std::size_t>(grid.nx) * grid.ny,
          "The bed elevation needs one value for each cell of the grid (or none); sample it on the solver's own grid.");
  require(
      bed.owner.empty() || bed.owner.size() == bed.elevation.size(),
      "The owners of the bed elevation need one number for each of its values (or none); fill both on the solver's own grid.");
  for (int owner : bed.owner) {
    require(owner >= -1 && owner < static_cast<int>(bed.obstacles.size()),
            "An owner of the bed elevation is not among the obstacles; give each its place in the list.");
  }
  blocks_x_ = (grid.nx + edge - 1) / edge;
  blocks_y_ = (grid.ny + edge - 1) / edge;
  blocks_.reserve(static_cast<std::size_t>(blocks_x_) * blocks_y_);
  for (int bj = 0; bj < blocks_y_; ++bj) {
    for (int bi = 0; bi < blocks_x_; ++bi) {
      Block b;
      b.grid = grid;
      b.i0 = bi * edge, b.j0 = bj * edge;
      b.nx = std::min(edge, grid.nx - b.i0), b.ny = std::min(edge, grid.ny - b.j0);
      lay_columns(b, surface, gravity, curvature);
      lay_bed(b, bed);
      blocks_.push_back(std::move(b));
    }
  }
}

CellPlace Mesh::place(int i, int j) const {
  const int number = (j / edge_) * blocks_x_ + i / edge_;
  const Block& b = blocks_[number];
  return {number, b.at(i - b.i0, j - b.j0)};
}

double Mesh::steepest() const {
  const double dx = grid_.dx, dy = grid_.dy;
  double most = 0;
  for (const Block& b : blocks_) {
    for (int j = 0; j < b.ny; ++j) {
      for (int i = 0; i < b.nx; ++i) {
        const int c = b.at(i, j), row = b.row(), column = i + Block::ghosts;
        const auto rise = [&](int step) {
          return std::max(std::abs(b.bed[c + step] - b.bed[c]), std::abs(b.bed[c] - b.bed[c - step]));
        };
        const double along = std::abs(b.drive[column]) + b.weight[column] * rise(1) / dx;
        most = std::max(most, along / dx + b.weight[column] * rise(row) / dy / dy);
      }
    }
  }
  return most;
}

void Mesh::lay_columns(Block& b, const ReferenceSurface& surface, double gravity, bool curvature) {
  for (int i = -Block::ghosts; i < b.nx + Block::ghosts; ++i) {
    // Wrapped round, so that a periodic ghost column has the bits of the column it stands for.
    const int column = ((b.i0 + i) % grid_.nx + grid_.nx) % grid_.nx;
    const double zeta = surface.angle(grid_.x(column));
    b.weight.push_back(gravity * std::cos(zeta));
    b.drive.push_back(gravity * std::sin(zeta));
    b.tan_zeta.push_back(std::tan(zeta));
    b.foot_depth.push_back(2 * grid_.dx * (i > -Block::ghosts ? b.tan_zeta[i + Block::ghosts - 1] : b.tan_zeta.back()));
    b.no_depth.push_back(0);
    b.kappa.push_back(curvature ? surface.curvature(grid_.x(column)) : 0.0);
    b.weight_face.push_back(gravity * std::cos(surface.angle(grid_.x0 + (b.i0 + i) * grid_.dx)));
  }
}

void Mesh::lay_bed(Block& b, const StepBed& bed) {
  b.bed.assign(b.size(), 0.0);
  b.top.assign(b.size(), 0.0);
  b.obstacle.assign(b.size(), -1);
  b.pushed.assign(b.size(), -1);
  for (int j = 0; j < b.ny; ++j) {
    for (int i = 0; i < b.nx; ++i) {
      const int c = b.at(i, j);
      if (!bed.elevation.empty()) b.bed[c] = bed.elevation[static_cast<std::size_t>(b.j0 + j) * grid_.nx + b.i0 + i];
      b.pushed[c] = pushed_by(b.i0 + i, b.j0 + j, bed);
      const double x = grid_.x(b.i0 + i), y = grid_.y(b.j0 + j);
      for (std::size_t k = 0; k < bed.obstacles.size(); ++k) {
        const StepObstacle& o = bed.obstacles[k];
        // Where footprints overlap the higher block is what the flow meets.
        if (o.covers(x, y) && o.height > b.top[c]) {
          b.top[c] = o.height;
          b.obstacle[c] = static_cast<int>(k);
        }
      }
    }
  }
}

// Neighbours are looked up as on a periodic domain: across a closed side there is no push to count.
int Mesh::pushed_by(int i, int j, const StepBed& bed) const {
  if (bed.owner.empty()) return -1;
  const auto owner = [&](int di, int dj) {
    const int ni = (i + di + grid_.nx) % grid_.nx, nj = (j + dj + grid_.ny) % grid_.ny;
    return bed.owner[static_cast<std::size_t>(nj) * grid_.nx + ni];
  };
  for (const int found : {owner(0, 0), owner(-1, 0), owner(1, 0), owner(0, -1), owner(0, 1)}) {
    if (found >= 0) return found;
  }
  return -1;
}

}  // namespace couloir
