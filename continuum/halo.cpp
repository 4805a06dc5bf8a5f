#include "continuum/halo.hpp"

#include <algorithm>
#include <cstring>

namespace couloir {

Halo::Halo(const Mesh& mesh, Ghosts& ghosts, const Ranks& ranks, const std::vector<int>& owner,
           const std::vector<const std::vector<GivenFace>*>& given)
    : ranks_(ranks) {
  if (ranks.alone()) return;
  const Lists none{std::vector<std::vector<Item>>(ranks.count()), std::vector<std::vector<Item>>(ranks.count())};
  for (auto* lists : {&cells_, &looks_, &fluxes_}) lists->assign(mesh.levels() + 1, none);
  const auto add = [&](Lists& lists, int from, int to, const Item& item) {
    if (from == to) return;
    if (from == ranks.mine()) lists.out[to].push_back(item);
    if (to == ranks.mine()) lists.in[from].push_back(item);
  };
  for (std::size_t k = 0; k < mesh.blocks().size(); ++k) {
    const int block = static_cast<int>(k), level = mesh.blocks()[k].level;
    ghosts.for_sources(block, [&](const CellPlace& p) {
      add(cells_[mesh.blocks()[p.block].level], owner[p.block], owner[k], {p.block, p.cell});
    });
    const auto& coarser = ghosts.coarser(block);
    for (std::size_t n = 0; n < coarser.size(); ++n) {
      add(looks_[level], owner[coarser[n].from.block], owner[k], {block, static_cast<int>(n)});
    }
    for (const GivenFace& g : *given[k]) add(fluxes_[mesh.blocks()[g.block].level], owner[k], owner[g.block], {g.block, g.slot});
  }
  // Both ends sort alike; several ghosts may take from one cell.
  for (auto* lists : {&cells_, &looks_, &fluxes_}) {
    for (Lists& l : *lists) {
      for (auto* side : {&l.out, &l.in}) {
        for (std::vector<Item>& items : *side) {
          std::sort(items.begin(), items.end());
          items.erase(std::unique(items.begin(), items.end()), items.end());
        }
      }
    }
  }
}

template <class Pack, class Unpack>
void Halo::tell(const Lists& lists, int numbers, Pack&& pack, Unpack&& unpack) const {
  std::vector<std::vector<double>> out(ranks_.count()), in(ranks_.count());
  for (int r = 0; r < ranks_.count(); ++r) {
    out[r].resize(lists.out[r].size() * numbers);
    in[r].resize(lists.in[r].size() * numbers);
    for (std::size_t n = 0; n < lists.out[r].size(); ++n) pack(lists.out[r][n], out[r].data() + n * numbers);
  }
  ranks_.exchange(out, in);
  for (int r = 0; r < ranks_.count(); ++r) {
    for (std::size_t n = 0; n < lists.in[r].size(); ++n) unpack(lists.in[r][n], in[r].data() + n * numbers);
  }
}

void Halo::tell_state(int level, std::vector<BlockState>& states) const {
  if (ranks_.alone()) return;
  tell(
      cells_[level], 3,
      [&](const Item& i, double* to) {
        const Fields& q = states[i.block].now;
        to[0] = q.h[i.at], to[1] = q.hu[i.at], to[2] = q.hv[i.at];
      },
      [&](const Item& i, const double* from) {
        Fields& q = states[i.block].now;
        q.h[i.at] = from[0], q.hu[i.at] = from[1], q.hv[i.at] = from[2];
      });
}

void Halo::tell_passive(int level, std::vector<BlockState>& states) const {
  if (ranks_.alone()) return;
  tell(
      cells_[level], 2,
      [&](const Item& i, double* to) { to[0] = states[i.block].passive_x[i.at], to[1] = states[i.block].passive_y[i.at]; },
      [&](const Item& i, const double* from) {
        states[i.block].passive_x[i.at] = from[0], states[i.block].passive_y[i.at] = from[1];
      });
}

void Halo::tell_looks(int level, Ghosts& ghosts) const {
  if (ranks_.alone()) return;
  using Look = Ghosts::Look;
  static_assert(sizeof(Look) % sizeof(double) == 0);
  tell(
      looks_[level], sizeof(Look) / sizeof(double),
      [&](const Item& i, double* to) { std::memcpy(to, &ghosts.coarser(i.block)[i.at].look, sizeof(Look)); },
      [&](const Item& i, const double* from) {
        std::memcpy(static_cast<void*>(&ghosts.coarser(i.block)[i.at].look), from, sizeof(Look));
      });
}

void Halo::tell_fluxes(int level, std::vector<LevelFluxes>& across) const {
  if (ranks_.alone()) return;
  tell(
      fluxes_[level], sizeof(LevelFlux) / sizeof(double),
      [&](const Item& i, double* to) { std::memcpy(to, &across[i.block][i.at], sizeof(LevelFlux)); },
      [&](const Item& i, const double* from) {
        std::memcpy(static_cast<void*>(&across[i.block][i.at]), from, sizeof(LevelFlux));
      });
}

}  // namespace couloir
