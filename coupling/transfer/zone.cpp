#include "coupling/transfer/zone.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/transfer/fill.hpp"

namespace couloir {

Zone::Zone(const ZoneSettings& settings, const Grid& grid, const ReferenceSurface& surface, const PackingTable& table)
    : settings_(settings),
      grid_(grid),
      surface_(&surface),
      table_(&table),
      rim_(grid, settings.box, surface, settings.rim),
      handback_(rim_, surface, table.grain_density()),
      next_id_(settings.first_id) {
  slide_.resize(rim_.faces().size());
  slid_.resize(rim_.faces().size());
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    const RimFace& face = rim_.faces()[f];
    conveyors_.emplace_back(face, f, table, rim_.layer());
    segments_.emplace_back(face.segments);
    imposed_.emplace_back(face.cells, 0.0);
  }
}

std::vector<NewGrain> Zone::take_over(Solver& solver) {
  const CellBox& box = settings_.box;
  const auto flow = [&](double x, double y) {
    const int i = std::clamp(int(std::floor((x - grid_.x0) / grid_.dx)), 0, grid_.nx - 1);
    const int j = std::clamp(int(std::floor((y - grid_.y0) / grid_.dy)), 0, grid_.ny - 1);
    return solver.at(i, j);
  };
  double mass = 0;
  for (int j = box.j0; j < box.j1; ++j)
    for (int i = box.i0; i < box.i1; ++i) mass += solver.at(i, j).h * grid_.dx * grid_.dy * table_->bulk_density();

  const FillBox zone{grid_.x0 + box.i0 * grid_.dx, grid_.x0 + box.i1 * grid_.dx, grid_.y0 + box.j0 * grid_.dy,
                     grid_.y0 + box.j1 * grid_.dy};
  std::vector<NewGrain> grains;
  look_outside(solver);
  if (mass > table_->mean_mass()) {
    // One body over zone, layers and buffers, so that no seam is left; what stands outside is driven or a shadow.
    FillBox all = zone;
    for (const RimFace& face : rim_.faces()) {
      const double out = rim_.buffer();
      if (face.side == SideName::upstream) all.x0 -= rim_.layer();
      if (face.side == SideName::downstream) all.x1 += out;
      if (face.side == SideName::left) all.y0 -= out;
      if (face.side == SideName::right) all.y1 += out;
    }
    all.walls = {settings_.rim.walls[0] && box.i0 == 0, settings_.rim.walls[1] && box.i1 == grid_.nx,
                 settings_.rim.walls[2] && box.j0 == 0, settings_.rim.walls[3] && box.j1 == grid_.ny};
    double filled = 0;
    for (NewGrain& g : fill(all, flow, 0, *table_, *surface_, next_id_)) {
      int out_of = -1;
      double distance = 0;
      for (int f = 0; f < int(rim_.faces().size()); ++f)
        if (const double s = rim_.faces()[f].distance(g.position); s < distance) out_of = f, distance = s;
      const double m = table_->grain_mass(g.radius);
      if (out_of < 0) {
        filled += m;
      } else {
        const RimFace& face = rim_.faces()[out_of];
        const int segment = face.segment_at(g.position);
        if (segments_[out_of][segment].inflow) {
          if (distance < -rim_.layer()) continue;
          g.face = out_of;
          g.segment = segment;
          note_driven(g);
          conveyors_[out_of].fill_up(segment);
        } else {
          handback_.mark_shadow(g.id);
        }
      }
      grains.push_back(g);
    }
    mass -= filled;
  }
  remainder_ = mass;
  own_from_ = next_id_;  // a lateral layer is cut across the way in which its conveyor's block lies
  fresh_ = true;
  inserted_ = long(grains.size());
  covered_ = solver.cover(box);
  return grains;
}

void Zone::impose(Solver& solver) {
  look_outside(solver);
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    const RimFace& face = rim_.faces()[f];
    for (int k = 0; k < face.cells; ++k) {
      const auto [i, j] = rim_.outside_cell(face, k);
      const auto [ci, cj] = rim_.inside_cell(face, k);
      const FlowState q = outside(solver, face, k);
      const Segment& segment = segments_[f][face.segment_of_cell(k)];
      double inward = 0, normal_momentum = 0, tangential = 0;
      if (segment.inflow) {
        const double raft = segment.rate > 0 ? segment.rate : segment.displacement / window_;
        inward = q.h * segment.rate;
        normal_momentum = inward * raft + push(solver, f, k, raft, weight(f, k));
        tangential = q.h > 0 ? inward * (face.axis() == 0 ? q.hv : q.hu) / q.h : 0;
      } else {
        // Not drawn in. Flow that comes towards the grains meets them as a wall; what leaves shares its pressure with them over
        // the depth that both have, so that grains beside an empty bed push nothing but themselves.
        const double shared = 0.5 * solver.earth_pressure(i, j)[face.axis()] * weight(f, k) * q.h * solver.at(ci, cj).h;
        const bool comes = face.sign() * (face.axis() == 0 ? q.hu : q.hv) > 0;
        normal_momentum = comes ? std::max(push(solver, f, k, 0, weight(f, k)), shared) : shared;
      }
      imposed_[f][k] = inward;
      // Parcels: mass and momentum that leave the zone, over the window, per unit width.
      const Parcel& parcel = handback_.pending()[f][k];
      const double per = 1 / (table_->bulk_density() * face.cell_width * window_);
      FaceFlux flux;
      const double s = face.sign();
      flux.mass = s * inward - s * per * parcel.mass;
      const double along_momentum = s * tangential;
      if (face.axis() == 0) {
        flux.mom_x = normal_momentum - s * per * parcel.mom_x;
        flux.mom_y = along_momentum - s * per * parcel.mom_y;
      } else {
        flux.mom_y = normal_momentum - s * per * parcel.mom_y;
        flux.mom_x = along_momentum - s * per * parcel.mom_x;
      }
      solver.impose(covered_, face.side, k, flux);
    }
  }
  solver.reset_rim(covered_);
}

// What passed is split into what the rafts asked for and what was handed back; a shortfall is the rafts'. Returns the mass [kg]
// that each segment's conveyor is given, [face][segment].
std::vector<std::vector<double>> Zone::count_passed(const Solver& solver) {
  std::vector<std::vector<double>> given;
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    const RimFace& face = rim_.faces()[f];
    given.emplace_back(face.segments, 0.0);
    for (int k = 0; k < face.cells; ++k) {
      Parcel& parcel = handback_.pending()[f][k];
      const double inward = face.sign() * solver.passed(covered_, face.side, k).mass * face.cell_width * table_->bulk_density();
      const double drawn = imposed_[f][k] * window_ * face.cell_width * table_->bulk_density();
      double to_conveyor = inward + parcel.mass;
      if (drawn <= 0) {  // none is drawn in: a shortfall stays in the parcel and is taken later
        parcel.mass = to_conveyor;
        to_conveyor = 0;
        parcel.mom_x = parcel.mom_y = 0;
      } else {
        parcel = {};
      }
      given[f][face.segment_of_cell(k)] += to_conveyor;
    }
  }
  return given;
}

AdvanceRequest Zone::request(Solver& solver) {
  look_outside(solver);
  auto all_given = count_passed(solver);
  AdvanceRequest request;
  request.steps = steps_;
  request.remove = remove_;
  remove_.clear();
  request.rim_moves = std::move(move_);
  request.insert = std::move(move_fill_);
  move_.clear();
  move_fill_.clear();
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    const RimFace& face = rim_.faces()[f];
    std::vector<double>& given = all_given[f];
    std::vector<double> depth(face.cells);
    for (int k = 0; k < face.cells; ++k) depth[k] = outside_depth(solver, face, k, conveyors_[f].filled(face.segment_of_cell(k)));

    conveyors_[f].slide(slid_[f]);
    slid_[f] = 0;
    std::vector<SegmentDrive> drives(face.segments);
    for (int s = 0; s < face.segments; ++s) {
      conveyors_[f].owe(s, given[s]);
      if (segments_[f][s].inflow) {
        feed(solver, f, s, given[s], depth, request.insert);
        drive_raft(solver, f, s, drives[s]);
      } else {
        conveyors_[f].empty(s);
        drive_strip(solver, f, s, drives[s]);
      }
      drives[s].slide = slide_[f];
    }
    request.drives.push_back(std::move(drives));
  }
  fresh_ = false;
  inserted_ += long(request.insert.size());
  return request;
}

void Zone::feed(const Solver& solver, int f, int s, double given, const std::vector<double>& depth,
                std::vector<NewGrain>& grains) {
  const Segment& segment = segments_[f][s];
  const std::size_t first_new = grains.size();
  conveyors_[f].advance(s, {segment.displacement, given, layer_due(solver, f, s), segment.raft, slide_[f], open_end(f, s)}, depth,
                        occupied(f, grains), next_id_, grains);
  for (std::size_t n = first_new; n < grains.size(); ++n) note_driven(grains[n]);
}

void Zone::absorb(const Advanced& advanced, Solver& solver, Airborne* airborne) {
  const Grains& g = advanced.grains;
  note_released(g);
  std::vector<std::vector<Handback::Outside>> outside;
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    outside.emplace_back();
    for (int s = 0; s < rim_.faces()[f].segments; ++s) {
      Segment& segment = segments_[f][s];
      segment.displacement = advanced.segments[f][s].displacement;
      // Where a raft has gone back it takes nothing out of the flow and gives nothing until it stands where it was.
      const double ahead = segment.displacement - segment.held;
      segment.held = std::max(0.0, -ahead);
      segment.rate = std::max(0.0, ahead) / window_;
      segment.raft = advanced.segments[f][s].velocity;
      if (advanced.segments[f][s].mass == 0 && segment.depth <= least_depth()) conveyors_[f].empty(s);  // a surge has passed
      outside.back().push_back({segment.inflow, segment.fast_outflow ? rim_.short_buffer() : rim_.buffer()});
    }
    slid_[f] = slide_[f] * window_;
  }
  find_layer(g);
  let_go_of_layer();
  thin_out_layer();
  const auto flies = [&](std::size_t k) {
    return airborne && airborne->take_off(g, k, table_->grain_mass(g.radius[k]), settings_.rim.diameter, solver);
  };
  handback_.sort(g, outside, remove_, flies);
  std::sort(remove_.begin(), remove_.end());
  remove_.erase(std::unique(remove_.begin(), remove_.end()), remove_.end());

  show(g, solver, true);
}

void Zone::rest(const Grains& g, Solver& solver) {
  closed_ = true;
  show(g, solver, false);
}

// Driven layers are gone with the engine, and what waited for its removal with them.
void Zone::wake() {
  closed_ = false;
  remove_.clear();
  layer_.clear();
  beside_.clear();
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    slid_[f] = 0;
    for (int s = 0; s < rim_.faces()[f].segments; ++s) {
      conveyors_[f].empty(s);
      segments_[f][s].displacement = segments_[f][s].held = 0;
    }
  }
}

void Zone::show(const Grains& g, Solver& solver, bool moving) {
  field_ =
      coarse_grain(g, grid_, settings_.box, *surface_, table_->grain_density(), table_->bulk_density(), settings_.periodic_y);
  const CellBox& box = settings_.box;
  for (int j = box.j0; j < box.j1; ++j)
    for (int i = box.i0; i < box.i1; ++i) {
      const FlowState q = field_.at(i, j);
      solver.set_covered(i, j, moving ? q : FlowState{q.h, 0, 0});
    }
}

void Zone::take_out(const std::vector<std::int64_t>& ids) {
  for (const std::int64_t id : ids) {
    handback_.mark_shadow(id);
    remove_.push_back(id);
  }
  std::sort(remove_.begin(), remove_.end());
  remove_.erase(std::unique(remove_.begin(), remove_.end()), remove_.end());
}

double Zone::faces_mass() const {
  double sum = handback_.pending_mass() + remainder_;
  for (const Conveyor& conveyor : conveyors_) sum += conveyor.owed();
  return sum;
}

// What is owed comes in with its raft.
double Zone::faces_momentum() const {
  double sum = handback_.pending_momentum();
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    for (int s = 0; s < rim_.faces()[f].segments; ++s) sum += conveyors_[f].owed(s) * speed_along_x(f, segments_[f][s].raft);
  }
  return sum;
}

double Zone::grains_mass(const Grains& g) const {
  double sum = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    if (is_counted(g.id[i])) sum += table_->grain_mass(g.radius[i]);
  return sum;
}

double Zone::grains_momentum(const Grains& g) const {
  double sum = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    if (is_counted(g.id[i])) {
      const Eigen::Vector3d t = surface_->tangent(surface_->to_surface({g.x[i], g.y[i], g.z[i]}).x);
      sum += table_->grain_mass(g.radius[i]) * (g.vx[i] * t.x() + g.vz[i] * t.z());
    }
  return sum;
}

}  // namespace couloir
