#include "continuum/noc/nested_noc.hpp"

#include <algorithm>
#include <stdexcept>

#include "continuum/bytes.hpp"
#include "continuum/noc/nested/nested_impl.hpp"

namespace couloir {
namespace {

constexpr std::uint64_t signature = 0x31747365636e6f63;  // changes with the layout

}  // namespace

NestedNoc::NestedNoc(const SolverSettings& s, const ReferenceSurface& surface, const NocBed& bed, const NocSettings& own)
    : impl_(std::make_unique<Impl>(s, surface, bed, own)) {}
NestedNoc::~NestedNoc() = default;
NestedNoc::NestedNoc(NestedNoc&&) noexcept = default;

const Grid& NestedNoc::grid() const {
  return impl_->base().grid();
}
double NestedNoc::time() const {
  return impl_->base().time();
}
void NestedNoc::set_time(double t) {
  impl_->set_time(noc::Nest::base, t);
}
PartTimes NestedNoc::part_times() const {
  PartTimes all = impl_->timer.times();
  for (const noc::Nest& n : impl_->nests) add(all, n.solver.part_times());
  return all;
}
std::int64_t NestedNoc::steps() const {
  return impl_->base().steps();
}
std::int64_t NestedNoc::cell_updates() const {
  std::int64_t sum = 0;
  for (const noc::Nest& n : impl_->nests) sum += n.solver.cell_updates();
  return sum;
}

void NestedNoc::set(const std::function<FlowState(double x, double y)>& state) {
  auto& nests = impl_->nests;
  for (noc::Nest& n : nests) n.solver.set(state);
  for (std::size_t k = nests.size(); k-- > 1;) {  // finer ones first
    const noc::Nest& n = nests[k];
    for (int j = n.foot.j0; j < n.foot.j1; ++j) {
      for (int i = n.foot.i0; i < n.foot.i1; ++i) nests[n.parent].solver.set(i, j, n.mean_over(i, j));
    }
  }
  for (std::size_t k = 0; k < nests.size(); ++k) impl_->fill_rims(static_cast<int>(k));
}

void NestedNoc::set(int i, int j, const FlowState& q) {
  auto& nests = impl_->nests;
  impl_->base().set(i, j, q);
  const auto fill = [&](const auto& self, int parent, const CellBox& cells) -> void {
    for (int child : nests[parent].children) {
      noc::Nest& n = nests[child];
      const CellBox part = n.covered(cells);
      if (part.empty()) continue;
      const CellBox own = n.finer(part);
      for (int fj = own.j0; fj < own.j1; ++fj) {
        for (int fi = own.i0; fi < own.i1; ++fi) n.solver.set(fi, fj, q);
      }
      self(self, child, own);
    }
  };
  fill(fill, noc::Nest::base, {i, i + 1, j, j + 1});
  for (std::size_t k = 0; k < nests.size(); ++k) impl_->fill_rims(static_cast<int>(k));
}

FlowState NestedNoc::at(int i, int j) const {
  return impl_->base().at(i, j);
}
void NestedNoc::gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const {
  impl_->base().gather(h, hu, hv);
}

std::vector<BlockPlace> NestedNoc::blocks() const {
  std::vector<BlockPlace> places;
  for (const noc::Nest& n : impl_->nests) {
    const CellBox& own = n.inside;
    places.push_back({n.level, n.i0 + own.i0, n.j0 + own.j0, own.i1 - own.i0, own.j1 - own.j0});
  }
  return places;
}

void NestedNoc::gather_block(int block, std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const {
  const noc::Nest& n = impl_->nests.at(block);
  h.clear(), hu.clear(), hv.clear();
  for (int j = n.inside.j0; j < n.inside.j1; ++j) {
    for (int i = n.inside.i0; i < n.inside.i1; ++i) {
      const FlowState q = n.solver.at(i, j);
      h.push_back(q.h), hu.push_back(q.hu), hv.push_back(q.hv);
    }
  }
}

void NestedNoc::for_finest(double x0, double x1, double y0, double y1, const std::function<void(const Sample&)>& f) const {
  // What lies beyond the domain is moved to its side, just within.
  const Grid& g = grid();
  const auto into = [](double at, double origin, double size, int n) {
    constexpr double little = 1e-6;
    return std::clamp(at, origin + little * size, origin + (n - little) * size);
  };
  x0 = into(x0, g.x0, g.dx, g.nx), x1 = into(x1, g.x0, g.dx, g.nx);
  y0 = into(y0, g.y0, g.dy, g.ny), y1 = into(y1, g.y0, g.dy, g.ny);
  for (std::size_t k = 0; k < impl_->nests.size(); ++k) {
    impl_->visit(static_cast<int>(k), centres_in(impl_->nests[k].solver.grid(), x0, x1, y0, y1), f);
  }
}

FlowState NestedNoc::interpolated(double x, double y) const {
  int finest = noc::Nest::base;
  for (std::size_t k = 1; k < impl_->nests.size(); ++k) {
    const noc::Nest& n = impl_->nests[k];
    const Grid& g = n.solver.grid();
    const CellBox& own = n.inside;
    const bool holds =
        x >= g.x0 + own.i0 * g.dx && x <= g.x0 + own.i1 * g.dx && y >= g.y0 + own.j0 * g.dy && y <= g.y0 + own.j1 * g.dy;
    if (holds) finest = static_cast<int>(k);
  }
  return impl_->nests[finest].solver.interpolated(x, y);
}

double NestedNoc::volume() const {
  return impl_->base().volume();
}
std::array<double, 2> NestedNoc::momentum() const {
  return impl_->base().momentum();
}
double NestedNoc::min_depth() const {
  double least = impl_->base().min_depth();
  for (const noc::Nest& n : impl_->nests) least = std::min(least, n.solver.min_depth());
  return least;
}
double NestedNoc::max_speed() const {
  double most = 0;
  for (const noc::Nest& n : impl_->nests) most = std::max(most, n.solver.max_speed());
  return most;
}

double NestedNoc::stable_dt() const {
  return impl_->stable_dt();
}
void NestedNoc::step(double dt) {
  impl_->advance(noc::Nest::base, std::min(dt, stable_dt()));
  impl_->keep_books();
}

std::array<double, 2> NestedNoc::obstacle_impulse(int id) const {
  return impl_->push(id);
}

int NestedNoc::add_control_box(const CellBox& box) {
  Impl::Pieces pieces;
  impl_->find_pieces(noc::Nest::base, box, pieces);
  impl_->boxes.push_back(std::move(pieces));
  return static_cast<int>(impl_->boxes.size()) - 1;
}
std::array<double, 2> NestedNoc::control_box_impulse(int id) const {
  std::array<double, 2> sum{};
  for (const Impl::Piece& p : impl_->boxes.at(id)) {
    const auto part = impl_->nests[p.nest].solver.control_box_impulse(p.id);
    for (int k : {0, 1}) sum[k] += p.sign * part[k];
  }
  return sum;
}

int NestedNoc::add_gauge(int i, int j0, int j1) {
  Impl::Pieces pieces;
  impl_->find_pieces(noc::Nest::base, i, j0, j1, pieces);
  impl_->gauges.push_back(std::move(pieces));
  return static_cast<int>(impl_->gauges.size()) - 1;
}
double NestedNoc::gauge(int id) const {
  double sum = 0;
  for (const Impl::Piece& p : impl_->gauges.at(id)) sum += p.sign * impl_->nests[p.nest].solver.gauge(p.id);
  return sum;
}

const Budget& NestedNoc::budget() const {
  return impl_->budget;
}
void NestedNoc::reset_budget() {
  impl_->drift_before += impl_->budget.mass_copied;
  impl_->pushed_before = impl_->push();
  for (noc::Nest& n : impl_->nests) n.solver.reset_budget();
  impl_->budget = {};
}
double NestedNoc::copy_drift() const {
  return impl_->drift_before + impl_->budget.mass_copied;
}

int NestedNoc::patches() const {
  return static_cast<int>(impl_->nests.size()) - 1;
}
int NestedNoc::level(int patch) const {
  return impl_->nests.at(patch + 1).level;
}
Grid NestedNoc::patch_grid(int patch) const {
  const noc::Nest& n = impl_->nests.at(patch + 1);
  Grid g = n.solver.grid();
  g.x0 += n.inside.i0 * g.dx, g.y0 += n.inside.j0 * g.dy;
  g.nx = n.inside.i1 - n.inside.i0, g.ny = n.inside.j1 - n.inside.j0;
  return g;
}
FlowState NestedNoc::patch_at(int patch, int i, int j) const {
  const noc::Nest& n = impl_->nests.at(patch + 1);
  if (!n.inside.contains(i + n.inside.i0, j + n.inside.j0)) throw std::out_of_range("There is no such cell on the patch.");
  return n.solver.at(i + n.inside.i0, j + n.inside.j0);
}

std::vector<std::uint8_t> NestedNoc::checkpoint() const {
  const Impl& m = *impl_;
  ByteWriter put;
  put(signature), put(static_cast<int>(m.nests.size())), put(m.drift_before), put(m.pushed_before), put(m.budget);
  for (const auto* all : {&m.boxes, &m.gauges}) {
    put(static_cast<int>(all->size()));
    for (const Impl::Pieces& pieces : *all) {
      put(static_cast<int>(pieces.size()));
      for (const Impl::Piece& p : pieces) put(p);
    }
  }
  for (const noc::Nest& n : m.nests) {
    const auto bytes = n.solver.checkpoint();
    put(bytes.size());
    put.bytes.insert(put.bytes.end(), bytes.begin(), bytes.end());
  }
  return std::move(put.bytes);
}

void NestedNoc::restore(const std::vector<std::uint8_t>& bytes) {
  Impl& m = *impl_;
  ByteReader in(bytes);
  if (in.take<std::uint64_t>() != signature || in.take<int>() != static_cast<int>(m.nests.size())) {
    throw std::invalid_argument(
        "The checkpoint belongs to another continuum (scheme or refined boxes differ); restore it with its own scene.");
  }
  m.drift_before = in.take<double>();
  m.pushed_before = in.take<std::array<double, 2>>();
  m.budget = in.take<Budget>();
  for (auto* all : {&m.boxes, &m.gauges}) {
    all->resize(in.take<int>());
    for (Impl::Pieces& pieces : *all) {
      pieces.resize(in.take<int>());
      for (Impl::Piece& p : pieces) p = in.take<Impl::Piece>();
    }
  }
  for (noc::Nest& n : m.nests) {
    std::vector<std::uint8_t> part(in.take<std::size_t>());
    for (std::uint8_t& byte : part) byte = in.take<std::uint8_t>();
    n.solver.restore(part);
  }
  if (!in.done()) throw std::invalid_argument("The continuum's checkpoint is longer than its state; restore an earlier one.");
  for (std::size_t k = 0; k < m.nests.size(); ++k) m.fill_rims(static_cast<int>(k));
}

}  // namespace couloir
