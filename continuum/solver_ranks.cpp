// What the ranks tell each other. All of them hold the whole state as it was when they last synchronised, and step their own
// blocks.

#include <algorithm>

#include "continuum/bytes.hpp"
#include "continuum/scheme/effects.hpp"
#include "continuum/solver_impl.hpp"

namespace couloir {

// A wet block costs its steps, a dry one next to nothing.
void Solver::Impl::deal() {
  const Ranks& ranks = settings.ranks;
  if (ranks.alone()) return;
  sync();
  forest->deal([&](const Leaf& leaf) {
    const int k = mesh.block_of(leaf);
    return k < 0 ? 0 : 1 + ((states[k].wet ? 16 : 0) << leaf.level);
  });
  std::vector<int> owner(mesh.blocks().size(), 0);
  owned.assign(owner.size(), 0);
  for (std::size_t n = 0; n < forest->leaves().size(); ++n) {
    const int k = mesh.block_of(forest->leaves()[n]);
    if (k < 0) continue;
    owner[k] = forest->owners()[n];
    owned[k] = owner[k] == ranks.mine();
  }
  std::vector<const std::vector<GivenFace>*> given;
  for (const BlockFaces& f : faces) given.push_back(&f.given);
  halo = Halo(mesh, *ghosts, ranks, owner, given);
  rate.reset();
}

void Solver::Impl::share_tallies() {
  if (settings.ranks.alone()) return;
  ByteWriter own;
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    if (!touched[k] || !mine(static_cast<int>(k))) continue;
    const Tally& t = tallies[k];
    own(k), own(t.budget), own(t.min_depth), own(t.finite), own(t.cell_updates);
    for (const auto& i : t.impulse) own(i);
    for (double g : t.gauge) own(g);
    for (const BoxTerms& b : t.boxes) own(b);
  }
  const std::vector<std::uint8_t> bytes = settings.ranks.gather(own.bytes);
  for (ByteReader all(bytes); !all.done();) {
    Tally& t = tallies[all.take<std::size_t>()];
    t.budget = all.take<Budget>();
    t.min_depth = all.take<double>();
    t.finite = all.take<bool>();
    t.cell_updates = all.take<std::int64_t>();
    for (auto& i : t.impulse) i = all.take<std::array<double, 2>>();
    for (double& g : t.gauge) g = all.take<double>();
    for (BoxTerms& b : t.boxes) b = all.take<BoxTerms>();
  }
}

void Solver::Impl::sync() {
  if (settings.ranks.alone()) return;
  if (std::find(changed.begin(), changed.end(), 1) == changed.end()) return;
  const bool shares = with_earth_pressure(parameters);
  const auto for_block = [&](std::size_t k, auto&& f) {
    const Block& b = mesh.blocks()[k];
    BlockState& s = states[k];
    for (auto* q : {&s.now.h, &s.now.hu, &s.now.hv, &s.passive_x, &s.passive_y}) {
      const bool there = shares || (q != &s.passive_x && q != &s.passive_y);
      for (int j = 0; there && j < b.ny; ++j) {
        for (int c = b.at(0, j); c < b.at(b.nx, j); ++c) f((*q)[c]);
      }
    }
  };
  ByteWriter own;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!changed[k] || !mine(static_cast<int>(k))) continue;
    own(k);
    for_block(k, [&](double q) { own(q); });
  }
  const std::vector<std::uint8_t> bytes = settings.ranks.gather(own.bytes);
  for (ByteReader all(bytes); !all.done();) {
    const auto k = all.take<std::size_t>();
    for_block(k, [&](double& q) { q = all.take<double>(); });
  }
  std::fill(changed.begin(), changed.end(), 0);
}

}  // namespace couloir
