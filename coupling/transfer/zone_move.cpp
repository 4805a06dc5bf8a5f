// A zone that goes on with another box (zone.hpp, take_from).
//
//        before                 now                        what stands in ... becomes
//      +--------+         +--------------+
//      |        |         |a|            |                 a  newly covered cells: grains, where none stand yet
//   ll |        |     ll' | |            |                 ll old driven layer: free; ll' new layer: driven
//      +--------+         +--------------+
//
// Mass: what leaves the solver (covered) or the count of grains is owed, what enters either pays; driven layers do not count.
// What is left over goes to the faces that draw flow in.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <unordered_set>

#include "coupling/transfer/fill.hpp"
#include "coupling/transfer/grain_bins.hpp"
#include "coupling/transfer/zone.hpp"

namespace couloir {

class RimMover {
 public:
  RimMover(Zone& now, const Zone& before, const Grains& grains, Solver& solver)
      : now_(now),
        before_(before),
        grains_(grains),
        solver_(solver),
        grid_(now.grid_),
        cell_mass_(grid_.dx * grid_.dy * now.table_->bulk_density()) {}

  Zone::Moved move() {
    carry_over();
    now_.look_outside(solver_);
    keep_segments();
    cover_new_cells();
    const auto flow = flow_before();
    solver_.move_zone(now_.covered_, now_.settings_.box);
    sort_grains();
    fill_new_cells(flow);
    for (const auto& [cell, q] : opened_) solver_.set(cell.first, cell.second, q);
    now_.move_.push_back(std::move(rim_));
    for (const RimFace& face : now_.rim_.faces()) now_.move_.back().faces.push_back(face.drive);
    std::sort(now_.remove_.begin(), now_.remove_.end());
    now_.remove_.erase(std::unique(now_.remove_.begin(), now_.remove_.end()), now_.remove_.end());
    now_.remainder_ += excess_;
    moved_.left_over = excess_;
    now_.share_out(moved_.left_over);
    return moved_;
  }

 private:
  using Cell = std::pair<int, int>;

  void carry_over() {
    now_.covered_ = before_.covered_;
    now_.next_id_ = before_.next_id_;
    now_.own_from_ = before_.next_id_;
    now_.inserted_ = before_.inserted_;
    now_.remainder_ = before_.remainder_;
    now_.steps_ = before_.steps_;
    now_.window_ = before_.window_;
    now_.remove_ = before_.remove_;
    now_.handback_.inherit(before_.handback_);
    now_.face_of_driven_ = before_.face_of_driven_;
  }

  // Parcels, debts and rafts of faces that stay in their plane; all else is left over. Layers that are new come filled.
  void keep_segments() {
    for (int g = 0; g < int(now_.rim_.faces().size()); ++g)
      for (int s = 0; s < now_.rim_.faces()[g].segments; ++s) now_.conveyors_[g].fill_up(s);
    for (int f = 0; f < int(before_.rim_.faces().size()); ++f) {
      const RimFace& old = before_.rim_.faces()[f];
      const int g = same_plane(old);
      if (g >= 0 && now_.rim_.faces()[g].slides) now_.slide_[g] = before_.slide_[f], now_.slid_[g] = before_.slid_[f];
      for (int k = 0; k < old.cells; ++k) {
        const Parcel& parcel = before_.handback_.pending()[f][k];
        const int to = g < 0 ? -1 : cell_on(g, before_.rim_.outside_cell(old, k));
        if (to < 0) {
          excess_ += parcel.mass;
        } else {
          now_.handback_.pending()[g][to] = parcel;
        }
      }
      for (int s = 0; s < old.segments; ++s) {
        const auto [first, past] = old.cells_of_segment(s);
        const int to = g < 0 ? -1 : cell_on(g, before_.rim_.outside_cell(old, (first + past) / 2));
        const double owed = before_.conveyors_[f].owed(s);
        if (to < 0) {
          excess_ += owed;
        } else {
          now_.conveyors_[g].owe(now_.rim_.faces()[g].segment_of_cell(to), owed);
        }
      }
      if (g < 0) continue;
      const RimFace& face = now_.rim_.faces()[g];
      for (int s = 0; s < face.segments; ++s) {
        const auto [first, past] = face.cells_of_segment(s);
        const int from = cell_of(old, before_.rim_, now_.rim_.outside_cell(face, (first + past) / 2));
        if (from < 0) continue;
        const int was = old.segment_of_cell(from);
        now_.conveyors_[g].go_on(s, before_.conveyors_[f], was);
        now_.segments_[g][s] = before_.segments_[f][was];
      }
    }
  }

  // The face of the same side in the same plane; -1: none.
  int same_plane(const RimFace& old) const {
    for (int g = 0; g < int(now_.rim_.faces().size()); ++g) {
      const RimFace& face = now_.rim_.faces()[g];
      const auto [i, j] = now_.rim_.outside_cell(face, 0);
      const auto [oi, oj] = before_.rim_.outside_cell(old, 0);
      if (face.side == old.side && (face.axis() == 0 ? i == oi : j == oj)) return g;
    }
    return -1;
  }
  static int cell_of(const RimFace& face, const Rim& rim, const Cell& outside) {
    const auto [i, j] = rim.outside_cell(face, 0);
    const int k = face.axis() == 0 ? outside.second - j : outside.first - i;
    return k >= 0 && k < face.cells ? k : -1;
  }
  int cell_on(int g, const Cell& outside) const { return cell_of(now_.rim_.faces()[g], now_.rim_, outside); }

  void cover_new_cells() {
    const CellBox& box = now_.settings_.box;
    for (int j = box.j0; j < box.j1; ++j)
      for (int i = box.i0; i < box.i1; ++i)
        if (!before_.settings_.box.contains(i, j)) moved_.covered += solver_.at(i, j).h * cell_mass_;
    excess_ += moved_.covered;
  }

  // The flow as it is now, not deeper than the packing.
  std::function<FlowState(double, double)> flow_before() const {
    const double deepest = 0.999 * now_.table_->areal_mass() / now_.table_->bulk_density();
    std::vector<FlowState> all(std::size_t(grid_.nx) * grid_.ny);
    for (int j = 0; j < grid_.ny; ++j)
      for (int i = 0; i < grid_.nx; ++i) {
        FlowState q = solver_.at(i, j);
        if (q.h > deepest) q = {deepest, q.hu * deepest / q.h, q.hv * deepest / q.h};
        all[std::size_t(j) * grid_.nx + i] = q;
      }
    return [this, all = std::move(all)](double x, double y) {
      const auto [i, j] = cell_at(x, y);
      return all[std::size_t(j) * grid_.nx + i];
    };
  }

  Cell cell_at(double x, double y) const {
    return {std::clamp(int(std::floor((x - grid_.x0) / grid_.dx)), 0, grid_.nx - 1),
            std::clamp(int(std::floor((y - grid_.y0) / grid_.dy)), 0, grid_.ny - 1)};
  }

  struct Outside {
    int face = -1, segment = -1;  // -1: inside of the zone
    double distance = 0;          // [m] negative
    bool inflow = false;
  };
  Outside where(const Vec& p) const {
    Outside out;
    const auto& faces = now_.rim_.faces();
    for (int f = 0; f < int(faces.size()); ++f)
      if (const double s = faces[f].distance(p); s < out.distance) out.face = f, out.distance = s;
    if (out.face < 0) return out;
    out.segment = faces[out.face].segment_at(p);
    out.inflow = now_.segments_[out.face][out.segment].inflow;
    return out;
  }

  // A counted, free grain that is outside now becomes flow where its cell has opened; else it is left over.
  void give_to_flow(std::size_t k, double mass) {
    const auto at = now_.surface_->to_surface({grains_.x[k], grains_.y[k], grains_.z[k]});
    const Cell cell = cell_at(at.x, at.y);
    const bool opens =
        before_.settings_.box.contains(cell.first, cell.second) && !now_.settings_.box.contains(cell.first, cell.second);
    if (!opens) {
      excess_ += mass;
      return;
    }
    const Eigen::Vector3d t = now_.surface_->tangent(at.x);
    FlowState& q = opened_[cell];
    q.h += mass / cell_mass_;
    q.hu += mass / cell_mass_ * (grains_.vx[k] * t.x() + grains_.vz[k] * t.z());
    q.hv += mass / cell_mass_ * grains_.vy[k];
    moved_.opened += mass;
  }

  void sort_grains() {
    const CellBox &old = before_.settings_.box, &box = now_.settings_.box;
    for (int j = old.j0; j < old.j1; ++j)  // cells that open empty, too
      for (int i = old.i0; i < old.i1; ++i)
        if (!box.contains(i, j)) opened_[{i, j}] = {};
    const std::unordered_set<std::int64_t> leaving(now_.remove_.begin(), now_.remove_.end());
    now_.layer_.clear();
    for (std::size_t k = 0; k < grains_.size(); ++k) {
      const std::int64_t id = grains_.id[k];
      const Vec p{grains_.x[k], grains_.y[k], grains_.z[k]};
      if (leaving.contains(id)) continue;
      const bool driven = grains_.driven[k] != 0, counted = now_.is_counted(id);
      const double mass = now_.table_->grain_mass(grains_.radius[k]);
      const Outside at = where(p);
      bool stays = true;
      if (driven) now_.face_of_driven_[id] = -1;
      if (at.face < 0) {
        if (!driven && !counted) now_.handback_.unmark_shadow(id);
        if (!counted) excess_ -= mass;
      } else if (at.inflow && at.distance >= -now_.rim_.layer()) {
        rim_.driven.push_back({id, at.face, at.segment});
        now_.layer_.push_back({id, p, {grains_.vx[k], grains_.vy[k], grains_.vz[k]}, grains_.radius[k], at.face, at.segment});
        if (counted) give_to_flow(k, mass);
        if (!driven && !counted) now_.handback_.unmark_shadow(id);
        now_.note_driven(now_.layer_.back());
      } else {
        if (counted) give_to_flow(k, mass);
        now_.handback_.mark_shadow(id);
        stays = !at.inflow && !driven && at.distance >= -now_.rim_.buffer();
      }
      if (stays && !now_.is_driven(id) && now_.is_where_layers_come(p)) now_.beside_.push_back({id, p, {}, grains_.radius[k]});
      if (stays) {
        bins_.add(p, grains_.radius[k]);
      } else {
        now_.remove_.push_back(id);
        ++moved_.freed;
      }
    }
  }

  // The parts of the new zone, layers and buffers included, that lie beyond the old one.
  std::vector<FillBox> strips() const {
    const auto extent = [&](const Zone& zone) {
      const CellBox& b = zone.settings_.box;
      FillBox all{grid_.x0 + b.i0 * grid_.dx, grid_.x0 + b.i1 * grid_.dx, grid_.y0 + b.j0 * grid_.dy, grid_.y0 + b.j1 * grid_.dy};
      for (const RimFace& face : zone.rim_.faces()) {
        const double out = zone.rim_.buffer();
        if (face.side == SideName::upstream) all.x0 -= zone.rim_.layer();
        if (face.side == SideName::downstream) all.x1 += out;
        if (face.side == SideName::left) all.y0 -= out;
        if (face.side == SideName::right) all.y1 += out;
      }
      const CellBox& box = zone.settings_.box;
      const auto& walls = zone.settings_.rim.walls;
      all.walls = {walls[0] && box.i0 == 0, walls[1] && box.i1 == grid_.nx, walls[2] && box.j0 == 0,
                   walls[3] && box.j1 == grid_.ny};
      return all;
    };
    const FillBox to = extent(now_), from = extent(before_);
    // Up to the old zone itself: what of its layers and buffers is filled already shows in the bins.
    const CellBox& b = before_.settings_.box;
    const double x0 = grid_.x0 + b.i0 * grid_.dx, x1 = grid_.x0 + b.i1 * grid_.dx, y0 = grid_.y0 + b.j0 * grid_.dy,
                 y1 = grid_.y0 + b.j1 * grid_.dy;
    std::vector<FillBox> all;
    const auto& w = to.walls;
    if (to.x0 < from.x0) all.push_back({to.x0, x0, to.y0, to.y1, {w[0], false, w[2], w[3]}});
    if (to.x1 > from.x1) all.push_back({x1, to.x1, to.y0, to.y1, {false, w[1], w[2], w[3]}});
    const double left = std::max(to.x0, x0), right = std::min(to.x1, x1);
    const bool low = w[0] && left == to.x0, high = w[1] && right == to.x1;
    if (to.y0 < from.y0) all.push_back({left, right, to.y0, y0, {low, high, w[2], false}});
    if (to.y1 > from.y1) all.push_back({left, right, y1, to.y1, {low, high, false, w[3]}});
    return all;
  }

  void fill_new_cells(const std::function<FlowState(double, double)>& flow) {
    constexpr double share = 0.98;  // as for conveyors: what an impact of half a metre a second makes
    for (const FillBox& strip : strips())
      for (NewGrain& g : fill(strip, flow, 0, *now_.table_, *now_.surface_, now_.next_id_)) {
        if (bins_.meets(g.position, g.radius, share)) continue;
        const double mass = now_.table_->grain_mass(g.radius);
        const Outside at = where(g.position);
        if (at.face < 0) {
          excess_ -= mass;
        } else if (at.inflow) {
          if (at.distance < -now_.rim_.layer()) continue;
          g.face = at.face, g.segment = at.segment;
          now_.note_driven(g);
          now_.layer_.push_back(g);
        } else {
          now_.handback_.mark_shadow(g.id);
        }
        bins_.add(g.position, g.radius);
        now_.move_fill_.push_back(g);
        ++moved_.filled;
      }
  }

  Zone& now_;
  const Zone& before_;
  const Grains& grains_;
  Solver& solver_;
  const Grid& grid_;
  double cell_mass_;  // [kg/m] of a metre of depth
  GrainBins bins_{1.25 * now_.settings_.rim.diameter, now_.period()};
  std::map<Cell, FlowState> opened_;
  RimMove rim_;
  double excess_ = 0;  // [kg]
  Zone::Moved moved_;
};

Zone::Moved Zone::take_from(const Zone& before, const Grains& grains, Solver& solver) {
  return RimMover(*this, before, grains, solver).move();
}

void Zone::give_up(Solver& solver) {
  const CellBox& box = settings_.box;
  for (int j = box.j0; j < box.j1; ++j)
    for (int i = box.i0; i < box.i1; ++i) solver.set_covered(i, j, {});
  solver.uncover(covered_);
}

void Zone::share_out(double mass) {
  double cells = 0;
  for (int f = 0; f < int(rim_.faces().size()); ++f)
    for (int s = 0; s < rim_.faces()[f].segments; ++s)
      if (segments_[f][s].inflow) cells += rim_.faces()[f].cells_per_segment;
  if (cells == 0) return;  // it stays on the faces
  remainder_ -= mass;
  for (int f = 0; f < int(rim_.faces().size()); ++f)
    for (int s = 0; s < rim_.faces()[f].segments; ++s)
      if (segments_[f][s].inflow) conveyors_[f].owe(s, mass * rim_.faces()[f].cells_per_segment / cells);
}

}  // namespace couloir
