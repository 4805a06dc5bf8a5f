#include "continuum/planes/planes_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "continuum/planes/planes_impl.hpp"

namespace couloir {
namespace {

constexpr std::uint64_t signature = 0x33656e616c706c63;  // changes with the layout
constexpr double tall = 1e6;                             // [m] the slope's own steps see a wall that nothing passes

void require(bool good, const char* sentence) {
  if (!good) throw std::invalid_argument(sentence);
}

CellBox footprint_of(const StepObstacle& o, const Grid& g) {
  const auto first = [](double edge, double origin, double size) {
    return static_cast<int>(std::ceil((edge - origin) / size - 0.5 - 1e-9));
  };
  const auto end = [](double edge, double origin, double size) {
    return static_cast<int>(std::floor((edge - origin) / size + 0.5 + 1e-9));
  };
  const CellBox box{std::max(0, first(o.x0, g.x0, g.dx)), std::min(g.nx, end(o.x1, g.x0, g.dx)),
                    std::max(0, first(o.y0, g.y0, g.dy)), std::min(g.ny, end(o.y1, g.y0, g.dy))};
  require(!box.empty(), "An obstacle made of planes must hold the centre of a cell; use smaller cells or move it.");
  return box;
}

// The cuboid as a wall that fills its cells exactly.
StepBed walled(StepBed bed, int cuboid, const CellBox& box, const Grid& g) {
  StepObstacle& o = bed.obstacles.at(static_cast<std::size_t>(cuboid));
  o.x0 = g.x0 + box.i0 * g.dx, o.x1 = g.x0 + box.i1 * g.dx;
  o.y0 = g.y0 + box.j0 * g.dy, o.y1 = g.y0 + box.j1 * g.dy;
  o.height = tall;
  return bed;
}

CuboidCells cells_of(const StepObstacle& o, const CellBox& box, const Grid& g) {
  const int nz = std::max(1, static_cast<int>(std::lround(o.height / g.dx)));
  return {box.i1 - box.i0, box.j1 - box.j0, nz, g.dx, g.dy, o.height / nz};
}

}  // namespace

PlanesModel::Impl::Impl(const SolverSettings& s, const ReferenceSurface& surface, const StepBed& bed, int number, double share)
    : box(footprint_of(bed.obstacles.at(static_cast<std::size_t>(number)), s.grid)),
      cells(cells_of(bed.obstacles[static_cast<std::size_t>(number)], box, s.grid)),
      cuboid(number),
      eta(share),
      dry_depth(s.dry_depth),
      slope(s, surface, walled(bed, number, box, s.grid)) {
  require(eta >= 0 && eta <= 1, "The share eta of an obstacle made of planes must be from 0 to 1; correct the scene.");
  const Grid& g = s.grid;
  const std::array<bool, 4> has_rim{box.i0 > 0, box.i1<g.nx, box.j0> 0, box.j1 < g.ny};
  require(has_rim[0], "An obstacle made of planes needs slope before its front; move it down from the upstream side.");
  for (int side = 0; side < 4; ++side) {
    require(has_rim[side] || s.sides[side].kind != Side::Kind::periodic,
            "An obstacle made of planes stands on a periodic side; move it inside or make the side a wall.");
  }
  for (SideName side : {SideName::upstream, SideName::downstream}) {
    const double x = g.x0 + (side == SideName::upstream ? box.i0 : box.i1) * g.dx;
    rim_weight[static_cast<int>(side)].assign(cells.ny, s.gravity * std::cos(surface.angle(x)));
  }
  for (int i = box.i0; i < box.i1; ++i) {
    for (int side : {2, 3}) rim_weight[side].push_back(s.gravity * std::cos(surface.angle(g.x(i))));
  }
  PlaneSettings common;
  common.closure = s.closure;
  common.limiter = s.limiter;
  common.cfl = s.cfl;
  common.dry_depth = s.dry_depth;
  const double zeta = surface.angle(g.x0 + 0.5 * (box.i0 + box.i1) * g.dx);
  for (int p = 0; p < plane_count; ++p) {
    planes.emplace_back(plane_settings(static_cast<PlaneName>(p), cells, s.gravity, zeta, common));
  }
  edges = cuboid_edges(cells, has_rim);
  for (const PlaneEdge& e : edges) flux.emplace_back(e.faces);
  hole = slope.cover(box);
}

PlanesModel::PlanesModel(const SolverSettings& s, const ReferenceSurface& surface, const StepBed& bed, int cuboid, double eta)
    : impl_(std::make_unique<Impl>(s, surface, bed, cuboid, eta)) {}
PlanesModel::~PlanesModel() = default;
PlanesModel::PlanesModel(PlanesModel&&) noexcept = default;

const Grid& PlanesModel::grid() const {
  return impl_->slope.grid();
}
double PlanesModel::time() const {
  return impl_->time;
}
void PlanesModel::set_time(double t) {
  impl_->time = t;
}
PartTimes PlanesModel::part_times() const {
  PartTimes all = impl_->timer.times();
  add(all, impl_->slope.part_times());
  return all;
}
std::int64_t PlanesModel::steps() const {
  return impl_->slope.steps();
}
std::int64_t PlanesModel::cell_updates() const {
  std::int64_t n = impl_->slope.cell_updates();
  for (const PlaneFlow& p : impl_->planes) n += p.updates();
  return n;
}

void PlanesModel::set(const std::function<FlowState(double x, double y)>& state) {
  const Grid& g = grid();
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      if (!impl_->box.contains(i, j)) impl_->slope.set(i, j, state(g.x(i), g.y(j)));
    }
  }
}

void PlanesModel::set(int i, int j, const FlowState& q) {
  const CellBox& box = impl_->box;
  if (!box.contains(i, j)) return impl_->slope.set(i, j, q);
  set_plane(PlaneName::top, i - box.i0, j - box.j0, q);
}

void PlanesModel::set_plane(PlaneName p, int i, int j, const FlowState& q) {
  impl_->plane(p).set(i, j, q);
  impl_->fresh = false;
}

FlowState PlanesModel::at(int i, int j) const {
  const CellBox& box = impl_->box;
  return box.contains(i, j) ? impl_->plane(PlaneName::top).at(i - box.i0, j - box.j0) : impl_->slope.at(i, j);
}

void PlanesModel::gather(std::vector<double>& h, std::vector<double>& hu, std::vector<double>& hv) const {
  impl_->slope.gather(h, hu, hv);
  const CellBox& box = impl_->box;
  for (int j = box.j0; j < box.j1; ++j) {
    for (int i = box.i0; i < box.i1; ++i) {
      const FlowState q = at(i, j);
      const std::size_t c = static_cast<std::size_t>(j) * grid().nx + i;
      h[c] = q.h, hu[c] = q.hu, hv[c] = q.hv;
    }
  }
}

double PlanesModel::volume() const {
  double sum = impl_->slope.volume();
  for (const PlaneFlow& p : impl_->planes) sum += p.volume();
  return sum;
}

std::array<double, 2> PlanesModel::momentum() const {
  std::array<double, 2> sum = impl_->slope.momentum();
  const auto on_planes = impl_->planes_momentum();
  for (int k : {0, 1}) sum[k] += on_planes[k];
  return sum;
}

std::array<double, 2> PlanesModel::Impl::planes_momentum() const {
  std::array<double, 2> sum{};
  for (int p = 0; p < plane_count; ++p) {
    const auto own = planes[p].momentum();
    const PlaneAxes axes = axes_of(static_cast<PlaneName>(p));
    if (axes.a < 2) sum[axes.a] += own[0];
    if (axes.b < 2) sum[axes.b] += own[1];
  }
  return sum;
}

std::array<double, 2> PlanesModel::Impl::taken() const {
  const auto has = planes_momentum();
  return {moved[0] - has[0], moved[1] - has[1]};
}

double PlanesModel::min_depth() const {
  double least = impl_->slope.min_depth();
  for (const PlaneFlow& p : impl_->planes) least = std::min(least, p.min_depth());
  return least;
}

double PlanesModel::max_speed() const {
  double fastest = impl_->slope.max_speed();
  for (const PlaneFlow& p : impl_->planes) fastest = std::max(fastest, p.max_speed());
  return fastest;
}

double PlanesModel::stable_dt() const {
  return impl_->stable_dt();
}
void PlanesModel::step(double dt) {
  impl_->step(dt);
}

std::array<double, 2> PlanesModel::obstacle_impulse(int id) const {
  return id == impl_->cuboid ? impl_->impulse : impl_->slope.obstacle_impulse(id);
}
int PlanesModel::add_control_box(const CellBox& box) {
  const CellBox& own = impl_->box;
  const int id = impl_->slope.add_control_box(box);
  if (box.i0 <= own.i0 && own.i1 <= box.i1 && box.j0 <= own.j0 && own.j1 <= box.j1) impl_->rounds.push_back({id, impl_->taken()});
  return id;
}
std::array<double, 2> PlanesModel::control_box_impulse(int id) const {
  std::array<double, 2> out = impl_->slope.control_box_impulse(id);
  const auto now = impl_->taken();
  for (const Impl::Round& r : impl_->rounds) {
    for (int k = 0; r.id == id && k < 2; ++k) out[k] += now[k] - r.taken[k];
  }
  return out;
}
int PlanesModel::add_gauge(int i, int j0, int j1) {
  return impl_->slope.add_gauge(i, j0, j1);
}
double PlanesModel::gauge(int id) const {
  return impl_->slope.gauge(id);
}

// What the slope loses through the rim is the obstacle's.
const Budget& PlanesModel::budget() const {
  Budget& sum = impl_->sum;
  sum = impl_->slope.budget();
  for (int k : {0, 1}) sum.obstacles[k] += sum.zone[k];
  sum.zone = {};
  sum.mass_zone = 0;
  sum.add(impl_->extra);
  return sum;
}
void PlanesModel::reset_budget() {
  impl_->slope.reset_budget();
  impl_->extra = {};
}

std::vector<std::uint8_t> PlanesModel::checkpoint() const {
  const Impl& m = *impl_;
  ByteWriter put;
  const std::vector<std::uint8_t> slope = m.slope.checkpoint();
  put(signature), put(m.box), put(m.cells.nz), put(slope.size());
  put.bytes.insert(put.bytes.end(), slope.begin(), slope.end());
  for (const PlaneFlow& p : m.planes) p.save(put);
  put(m.extra), put(m.impulse), put(m.moved), put(m.time), put(m.overflow);
  put(static_cast<int>(m.rounds.size()));
  for (const Impl::Round& r : m.rounds) put(r);
  return std::move(put.bytes);
}

void PlanesModel::restore(const std::vector<std::uint8_t>& bytes) {
  Impl& m = *impl_;
  ByteReader in(bytes);
  const bool ours = in.take<std::uint64_t>() == signature;
  const CellBox box = in.take<CellBox>();
  const bool same = ours && box.i0 == m.box.i0 && box.i1 == m.box.i1 && box.j0 == m.box.j0 && box.j1 == m.box.j1;
  if (in.take<int>() != m.cells.nz || !same) {
    throw std::invalid_argument("The checkpoint belongs to another obstacle made of planes; restore it with its own scene.");
  }
  std::vector<std::uint8_t> slope(in.take<std::size_t>());
  for (std::uint8_t& byte : slope) byte = in.take<std::uint8_t>();
  m.slope.restore(slope);
  for (PlaneFlow& p : m.planes) p.restore(in);
  m.extra = in.take<Budget>();
  m.impulse = in.take<std::array<double, 2>>();
  m.moved = in.take<std::array<double, 2>>();
  m.time = in.take<double>(), m.overflow = in.take<double>();
  m.rounds.resize(in.take<int>());
  for (Impl::Round& r : m.rounds) r = in.take<Impl::Round>();
  m.fresh = false;
  if (!in.done()) throw std::invalid_argument("The continuum's checkpoint is longer than its state; restore an earlier one.");
}

const CellBox& PlanesModel::footprint() const {
  return impl_->box;
}
const PlaneFlow& PlanesModel::plane(PlaneName p) const {
  return impl_->plane(p);
}
double PlanesModel::overflow() const {
  return impl_->overflow;
}

double PlanesModel::heap() const {
  double deepest = 0;
  for (int j = impl_->box.j0; j < impl_->box.j1; ++j) deepest = std::max(deepest, impl_->slope.at(impl_->box.i0 - 1, j).h);
  return deepest;
}

double PlanesModel::climbed(double least_depth) const {
  const PlaneFlow& front = impl_->plane(PlaneName::front);
  for (int i = front.grid().nx; i > 0; --i) {
    for (int j = 0; j < front.grid().ny; ++j) {
      if (front.at(i - 1, j).h >= least_depth) return i * front.grid().dx;
    }
  }
  return 0;
}

}  // namespace couloir
