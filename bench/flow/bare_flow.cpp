#include <algorithm>
#include <array>
#include <cmath>

#include "bench/flow/bare_kernel.hpp"
#include "continuum/isa/isa.hpp"

namespace couloir::bench {

extern "C" const BareKernel couloir_bare_baseline, couloir_bare_avx2, couloir_bare_avx512;

BareFlow::BareFlow(int nx, int ny, double g)
    : blocks_x_(nx / BareBlock::edge), blocks_y_(ny / BareBlock::edge), g_(g), blocks_(blocks_x_ * blocks_y_) {
  constexpr std::array kernels{&couloir_bare_baseline, &couloir_bare_avx2, &couloir_bare_avx512};
  kernel_ = kernels[static_cast<std::size_t>(chosen_isa())];
  for (BareBlock& b : blocks_) {
    for (auto* a : {&b.h, &b.hu, &b.hv, &b.h0, &b.hu0, &b.hv0}) a->assign(BareBlock::size, 1.0);
  }
  BareScratch& w = scratch_;
  for (auto* a : {&w.u, &w.v, &w.h_lo, &w.h_hi, &w.un_lo, &w.un_hi, &w.ut_lo, &w.ut_hi}) a->resize(BareBlock::size);
  for (auto* fluxes : {w.mass, w.normal, w.tangent}) {
    for (int axis : {0, 1}) fluxes[axis].resize(BareBlock::size);
  }
  w.fastest.resize(BareBlock::edge);
}

void BareFlow::set(const std::function<FlowState(int i, int j)>& state) {
  constexpr int edge = BareBlock::edge;
  fastest_ = 0;
  for (int j = 0; j < blocks_y_ * edge; ++j) {
    for (int i = 0; i < blocks_x_ * edge; ++i) {
      BareBlock& b = blocks_[(j / edge) * blocks_x_ + i / edge];
      const int c = BareBlock::at(i % edge, j % edge);
      const FlowState q = state(i, j);
      b.h[c] = q.h, b.hu[c] = q.hu, b.hv[c] = q.hv;
      fastest_ = std::max(fastest_, (std::abs(q.hu) + std::abs(q.hv)) / q.h + 2 * std::sqrt(g_ * q.h));
    }
  }
}

void BareFlow::fill_ghosts() {
  constexpr int edge = BareBlock::edge, two = Block::ghosts;
  const auto block = [&](int bi, int bj) -> const BareBlock& {
    return blocks_[(bj + blocks_y_) % blocks_y_ * blocks_x_ + (bi + blocks_x_) % blocks_x_];
  };
  // Rows of `n` cells from (i, j) of one block to (i - di edge, j - dj edge) of another.
  const auto copy = [](const BareBlock& from, BareBlock& to, int i, int j, int n, int di, int dj) {
    const int a = BareBlock::at(i, j), b = BareBlock::at(i + di * edge, j + dj * edge);
    std::copy_n(&from.h[a], n, &to.h[b]);
    std::copy_n(&from.hu[a], n, &to.hu[b]);
    std::copy_n(&from.hv[a], n, &to.hv[b]);
  };
  for (int bj = 0; bj < blocks_y_; ++bj) {
    for (int bi = 0; bi < blocks_x_; ++bi) {
      BareBlock& to = blocks_[bj * blocks_x_ + bi];
      for (int j = 0; j < edge; ++j) {
        copy(block(bi - 1, bj), to, edge - two, j, two, -1, 0);
        copy(block(bi + 1, bj), to, 0, j, two, 1, 0);
      }
      for (int k = 0; k < two; ++k) {
        copy(block(bi, bj - 1), to, 0, edge - two + k, edge, 0, -1);
        copy(block(bi, bj + 1), to, 0, k, edge, 0, 1);
      }
    }
  }
}

void BareFlow::step() {
  const double courant = 0.45 / fastest_;
  for (const bool corrector : {false, true}) {
    fill_ghosts();
    double fastest = 0;
    for (BareBlock& b : blocks_) fastest = std::max(fastest, kernel_->stage(b, scratch_, corrector, courant, g_));
    if (corrector) fastest_ = fastest;
    updates_ += static_cast<long>(blocks_.size()) * BareBlock::edge * BareBlock::edge;
  }
}

}  // namespace couloir::bench
