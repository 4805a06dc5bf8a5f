#include "continuum/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace couloir {
namespace {

void require(bool good, const char* sentence) {
  if (!good) throw std::invalid_argument(sentence);
}

// The slopes of surface and depth in a cell beside an elevation need not cancel: at its face to the next cell its bed seems to
// rise.
constexpr int reach_of_a_push[][2] = {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-2, 0}, {2, 0}, {0, -2}, {0, 2}};

int wrapped(int i, int n) {
  return ((i % n) + n) % n;
}

}  // namespace

Mesh::Mesh(const Grid& grid, int edge, const ReferenceSurface& surface, const StepBed& bed, double gravity, bool curvature,
           int levels)
    : grid_(grid), edge_(edge), levels_(levels), surface_(surface), bed_(bed), gravity_(gravity), curvature_(curvature) {
  require(grid.nx > 0 && grid.ny > 0, "The grid needs at least one cell in x and in y; enlarge the terrain or refine the cell.");
  require(grid.dx > 0 && grid.dy > 0, "The cells need a positive size; correct continuum.cell.");
  require(edge >= 2, "A block needs at least 2 cells along its edge; raise the block size.");
  // So that a cell of the coarsest grid never straddles two blocks.
  require(levels == 0 || (edge % (1 << levels) == 0 && edge >= 4),
          "The cells along the edge of refined blocks must be a multiple of 2 to the power of the levels, and at least 4; change "
          "the block size.");
  require(bed.elevation.empty() || bed.elevation.size() == static_cast<std::size_t>(grid.nx) * grid.ny,
          "The bed elevation needs one value for each cell of the grid (or none); sample it on the solver's own grid.");
  require(bed.elevation.empty() || levels == 0 || bed.height,
          "Refined cells need the bed elevation as a function of place, too; give StepBed::height.");
  require(
      bed.owner.empty() || bed.owner.size() == bed.elevation.size(),
      "The owners of the bed elevation need one number for each of its values (or none); fill both on the solver's own grid.");
  for (int owner : bed.owner) {
    require(owner >= -1 && owner < static_cast<int>(bed.obstacles.size()),
            "An owner of the bed elevation is not among the obstacles; give each its place in the list.");
  }
  blocks_x_ = (grid.nx + edge - 1) / edge;
  blocks_y_ = (grid.ny + edge - 1) / edge;
  std::vector<Leaf> leaves;
  for (int bj = 0; bj < blocks_y_; ++bj) {
    for (int bi = 0; bi < blocks_x_; ++bi) leaves.push_back({0, bi, bj});
  }
  become(leaves);
}

void Mesh::become(const std::vector<Leaf>& leaves) {
  std::vector<Block> blocks;
  std::vector<Leaf> kept;
  for (const Leaf& leaf : leaves) {
    const Grid g = grid_.refined(leaf.level);
    if (leaf.bi * edge_ >= g.nx || leaf.bj * edge_ >= g.ny) continue;
    const int old = number_.empty() ? -1 : block_of(leaf);
    blocks.push_back(old >= 0 ? std::move(blocks_[old]) : make(leaf));
    kept.push_back(leaf);
  }
  blocks_ = std::move(blocks);
  leaves_ = std::move(kept);
  index();
}

Block Mesh::make(const Leaf& leaf) const {
  Block b;
  b.grid = grid_.refined(leaf.level);
  b.level = leaf.level;
  b.i0 = leaf.bi * edge_, b.j0 = leaf.bj * edge_;
  b.nx = std::min(edge_, b.grid.nx - b.i0), b.ny = std::min(edge_, b.grid.ny - b.j0);
  lay_columns(b);
  lay_bed(b);
  return b;
}

void Mesh::index() {
  number_.assign(levels_ + 1, {});
  for (int level = 0; level <= levels_; ++level) {
    number_[level].assign(static_cast<std::size_t>(blocks_x_ << level) * (blocks_y_ << level), -1);
  }
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const Leaf& l = leaves_[k];
    number_[l.level][static_cast<std::size_t>(l.bj) * (blocks_x_ << l.level) + l.bi] = static_cast<int>(k);
  }
}

int Mesh::block_of(const Leaf& l) const {
  if (l.level < 0 || l.level > levels_) return -1;
  const int nx = blocks_x_ << l.level, ny = blocks_y_ << l.level;
  if (l.bi < 0 || l.bj < 0 || l.bi >= nx || l.bj >= ny) return -1;
  return number_[l.level][static_cast<std::size_t>(l.bj) * nx + l.bi];
}

Mesh::Found Mesh::find(int level, int i, int j) const {
  const auto in = [&](int at) -> Found {
    const int ci = at >= level ? i << (at - level) : i >> 1, cj = at >= level ? j << (at - level) : j >> 1;
    const int k = block_of({at, ci / edge_, cj / edge_});
    if (k < 0) return {-1, at, -1};
    const Block& b = blocks_[k];
    return {k, at, b.at(ci - b.i0, cj - b.j0)};
  };
  for (int at : {level, level - 1, level + 1}) {
    if (at < 0 || at > levels_) continue;
    const Found f = in(at);
    if (f.block >= 0) return f;
  }
  return {-1, level, -1};
}

Mesh::Patch Mesh::over(int i, int j) const {
  for (int level = 0; level <= levels_; ++level) {
    const int k = block_of({level, (i << level) / edge_, (j << level) / edge_});
    if (k >= 0) return {k, (i << level) - blocks_[k].i0, (j << level) - blocks_[k].j0, 1 << level};
  }
  throw std::logic_error("a cell of the grid has no block");
}

double Mesh::steepest() const {
  double most = 0;
  for (const Block& b : blocks_) {
    const double dx = b.grid.dx, dy = b.grid.dy, steps = 1 << b.level;
    for (int j = 0; j < b.ny; ++j) {
      for (int i = 0; i < b.nx; ++i) {
        const int c = b.at(i, j), row = b.row(), column = i + Block::ghosts;
        const auto rise = [&](int step) {
          return std::max(std::abs(b.bed[c + step] - b.bed[c]), std::abs(b.bed[c] - b.bed[c - step]));
        };
        const double along = std::abs(b.drive[column]) + b.weight[column] * rise(1) / dx;
        most = std::max(most, (along / dx + b.weight[column] * rise(row) / dy / dy) / (steps * steps));
      }
    }
  }
  return most;
}

void Mesh::lay_columns(Block& b) const {
  for (int i = -Block::ghosts; i < b.nx + Block::ghosts; ++i) {
    // Wrapped round, so that a periodic ghost column has the bits of the column it stands for.
    const int column = wrapped(b.i0 + i, b.grid.nx);
    const double zeta = surface_.angle(b.grid.x(column));
    b.weight.push_back(gravity_ * std::cos(zeta));
    b.drive.push_back(gravity_ * std::sin(zeta));
    b.tan_zeta.push_back(std::tan(zeta));
    b.foot_depth.push_back(2 * b.grid.dx * (i > -Block::ghosts ? b.tan_zeta[i + Block::ghosts - 1] : b.tan_zeta.back()));
    b.no_depth.push_back(0);
    b.kappa.push_back(curvature_ ? surface_.curvature(b.grid.x(column)) : 0.0);
    b.weight_face.push_back(gravity_ * std::cos(surface_.angle(b.grid.x0 + (b.i0 + i) * b.grid.dx)));
  }
}

std::pair<double, int> Mesh::step_at(double x, double y) const {
  std::pair<double, int> found{0, -1};
  for (std::size_t k = 0; k < bed_.obstacles.size(); ++k) {
    const StepObstacle& o = bed_.obstacles[k];
    // Where footprints overlap the higher block is what the flow meets.
    if (const double top = o.height > 0 ? o.top(x, y) : 0; top > found.first) found = {top, static_cast<int>(k)};
  }
  return found;
}

void Mesh::lay_bed(Block& b) const {
  b.bed.assign(b.size(), 0.0);
  b.top.assign(b.size(), 0.0);
  b.obstacle.assign(b.size(), -1);
  b.pushed.assign(b.size(), -1);
  for (int j = 0; j < b.ny; ++j) {
    for (int i = 0; i < b.nx; ++i) {
      const int c = b.at(i, j);
      if (!bed_.elevation.empty()) b.bed[c] = elevation(b, b.i0 + i, b.j0 + j);
      b.pushed[c] = pushed_by(b, b.i0 + i, b.j0 + j);
      std::tie(b.top[c], b.obstacle[c]) = step_at(b.grid.x(b.i0 + i), b.grid.y(b.j0 + j));
    }
  }
}

// Where cells may be refined, the mean over the finest there can be: so what a cell and its children hold under one surface is
// the same, and a lake stays level whatever the mesh does.
double Mesh::elevation(const Block& b, int i, int j) const {
  if (levels_ == 0) return bed_.elevation[static_cast<std::size_t>(j) * grid_.nx + i];
  const int down = levels_ - b.level;
  const auto mean = [&](auto& self, int left, int ci, int cj) -> double {
    if (left == 0) {
      const Grid finest = grid_.refined(levels_);
      return bed_.height(finest.x(ci), finest.y(cj));
    }
    const double low = self(self, left - 1, 2 * ci, 2 * cj) + self(self, left - 1, 2 * ci + 1, 2 * cj);
    const double high = self(self, left - 1, 2 * ci, 2 * cj + 1) + self(self, left - 1, 2 * ci + 1, 2 * cj + 1);
    return 0.25 * (low + high);
  };
  return mean(mean, down, i, j);
}

// Neighbours are looked up as on a periodic domain: across a closed side there is no push to count.
int Mesh::pushed_by(const Block& b, int i, int j) const {
  if (bed_.owner.empty()) return -1;
  const auto owner = [&](int di, int dj) {
    const int ni = wrapped(i + di, b.grid.nx), nj = wrapped(j + dj, b.grid.ny);
    return levels_ > 0 ? bed_.owner_at(b.grid.x(ni), b.grid.y(nj)) : bed_.owner[static_cast<std::size_t>(nj) * grid_.nx + ni];
  };
  for (const auto& [di, dj] : reach_of_a_push) {
    const int found = owner(di, dj);
    if (found >= 0) return found;
  }
  if (levels_ == 0) return -1;
  // A larger cell may have some of an elevation and its centre none. Beside a change of level a cell's neighbour is such a one,
  // and that one's bed may come from a still larger one's.
  for (int l = b.level; l >= 0; --l) {
    const int up = b.level - l;
    for (const auto& [di, dj] : reach_of_a_push) {
      const int found = owner_in(l, wrapped(i + di, b.grid.nx) >> up, wrapped(j + dj, b.grid.ny) >> up);
      if (found >= 0) return found;
    }
  }
  return -1;
}

int Mesh::owner_in(int level, int i, int j) const {
  const Grid g = grid_.refined(level), finest = grid_.refined(levels_);
  const double x = g.x(i), y = g.y(j);
  const auto reaches = [&](const StepObstacle& o) {
    return o.x0 < x + g.dx && o.x1 > x - g.dx && o.y0 < y + g.dy && o.y1 > y - g.dy;
  };
  if (std::ranges::none_of(bed_.obstacles, reaches)) return -1;
  const auto [known, unknown] = owners_.try_emplace({level, i, j}, -1);
  const int n = 1 << (levels_ - level);
  for (int c = 0; unknown && known->second < 0 && c < n * n; ++c)
    known->second = bed_.owner_at(finest.x(i * n + c % n), finest.y(j * n + c / n));
  return known->second;
}

}  // namespace couloir
