// The driven layers before a zone's faces (zone.hpp): what stands there, what should, what leaves them.

#include <algorithm>
#include <cmath>

#include "coupling/transfer/grain_bins.hpp"
#include "coupling/transfer/zone.hpp"

namespace couloir {

Conveyor::Occupied Zone::occupied(int face, const std::vector<NewGrain>& inserted) const {
  // Two per cent: what an impact of half a metre a second makes. More would throw the grain out of the flow when it is freed.
  return [this, face, &inserted](int segment, const Vec& p, double r) {
    const auto overlaps = [&](const NewGrain& g) {
      const double straight = g.position[1] - p[1], dy = across(straight);
      const bool own = g.face == face && g.segment == segment && g.id >= own_from_ && dy == straight;
      if (own && slide_[face] == 0) return false;
      const double dx = g.position[0] - p[0], dz = g.position[2] - p[2];
      const double reach = 0.98 * (g.radius + r);
      return dx * dx + dy * dy + dz * dz < reach * reach;
    };
    return std::any_of(layer_.begin(), layer_.end(), overlaps) || std::any_of(inserted.begin(), inserted.end(), overlaps) ||
           std::any_of(beside_.begin(), beside_.end(), overlaps);
  };
}

double Zone::across(double dy) const {
  return settings_.periodic_y ? dy - period() * std::round(dy / period()) : dy;
}

void Zone::find_layer(const Grains& g) {
  layer_.clear();
  beside_.clear();
  for (std::size_t i = 0; i < g.size(); ++i) {
    const Vec p{g.x[i], g.y[i], g.z[i]};
    if (!g.driven[i]) {
      if (is_where_layers_come(p)) beside_.push_back({g.id[i], p, {}, g.radius[i]});
      continue;
    }
    const int f = face_of_driven_[g.id[i]];
    const RimFace& face = rim_.faces()[f];
    layer_.push_back({g.id[i], p, {g.vx[i], g.vy[i], g.vz[i]}, g.radius[i], f, face.segment_at(p)});
  }
}

bool Zone::is_where_layers_come(const Vec& p) const {
  const double d = settings_.rim.diameter;
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    const double s = rim_.faces()[f].distance(p);
    if (s > -rim_.layer() - d && s < d && (slide_[f] != 0 || conveyors_[f].filling())) return true;
  }
  return false;
}

void Zone::note_driven(const NewGrain& g) {
  if (g.id >= std::int64_t(face_of_driven_.size())) face_of_driven_.resize(2 * g.id + 1000, -1);
  face_of_driven_[g.id] = static_cast<signed char>(g.face);
}

bool Zone::open_end(int f, int s) const {
  if (slide_[f] == 0) return false;
  const int beyond = slide_[f] > 0 ? s - 1 : s + 1;
  return beyond < 0 || beyond >= int(segments_[f].size()) || !segments_[f][beyond].inflow;
}

double Zone::outside_depth(const Solver& solver, const RimFace& face, int k, double distance) const {
  auto [i, j] = rim_.outside_cell(face, k);
  int& at = face.axis() == 0 ? i : j;
  at -= int(face.sign()) * int((1 - 1e-9) * distance / (face.axis() == 0 ? grid_.dx : grid_.dy));
  return solver.at(std::clamp(i, 0, grid_.nx - 1), std::clamp(j, 0, grid_.ny - 1)).h;
}

// A layer should hold what the flow holds over its depth, and what is owed.
double Zone::layer_due(const Solver& solver, int f, int s) const {
  const RimFace& face = rim_.faces()[f];
  const auto [first, past] = face.cells_of_segment(s);
  const double step = face.axis() == 0 ? grid_.dx : grid_.dy, depth = conveyors_[f].filled(s);
  double due = conveyors_[f].owed(s);
  for (int k = first; k < past; ++k)
    for (double from = 0; from < depth; from += step) {
      const double to = std::min(depth, from + step);
      due += outside_depth(solver, face, k, 0.5 * (from + to)) * (to - from) * face.cell_width * table_->bulk_density();
    }
  for (const NewGrain& g : layer_) {
    if (g.face != f || g.segment != s || !is_driven(g.id)) continue;
    const double along = face.along(g.position);
    if (along >= 0 && along < face.extent()) due -= table_->grain_mass(g.radius);
  }
  return due;
}

// What has passed a face counts, and pays.
void Zone::note_released(const Grains& grains) {
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (grains.driven[i] || !is_driven(grains.id[i])) continue;
    const int f = face_of_driven_[grains.id[i]];
    const RimFace& face = rim_.faces()[f];
    const int s = face.segment_at({grains.x[i], grains.y[i], grains.z[i]});
    conveyors_[f].owe(s, -table_->grain_mass(grains.radius[i]));
    face_of_driven_[grains.id[i]] = -1;
  }
}

// Driven grains where the flow has turned away will not come in, nor those that have slid past their face's end, or before a
// segment without a raft. What is owed where the flow has turned away goes back to it with its own
// velocity.
void Zone::let_go_of_layer() {
  for (const NewGrain& g : layer_) {
    const RimFace& face = rim_.faces()[g.face];
    const double along = face.along(g.position);
    const bool past_end = (slide_[g.face] > 0 && along >= face.extent()) || (slide_[g.face] < 0 && along < 0);
    if (past_end || !segments_[g.face][g.segment].inflow) take_from_layer(g);
  }
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    const RimFace& face = rim_.faces()[f];
    for (int s = 0; s < face.segments; ++s) {
      if (segments_[f][s].inflow) continue;
      const int middle = std::min(face.cells - 1, s * face.cells_per_segment + face.cells_per_segment / 2);
      const double owed = conveyors_[f].owed(s), inward = face.sign() * segments_[f][s].comes, along = segments_[f][s].along;
      Parcel& parcel = handback_.pending()[f][middle];
      parcel.mass += owed;
      parcel.mom_x += owed * (face.axis() == 0 ? inward : along);
      parcel.mom_y += owed * (face.axis() == 0 ? along : inward);
      conveyors_[f].owe(s, -owed);
    }
  }
}

void Zone::take_from_layer(const NewGrain& g) {
  remove_.push_back(g.id);
  face_of_driven_[g.id] = -1;
  handback_.mark_shadow(g.id);  // in the engine until the next window
}

// Rafts of one face that move at different velocities push their grains into each other, and what is freed so is shot away: the
// later of two goes.
void Zone::thin_out_layer() {
  constexpr double share = 0.9;  // of the sum of the radii
  GrainBins stays(1.25 * settings_.rim.diameter, period());
  for (const NewGrain& g : layer_) {
    if (!is_driven(g.id)) continue;
    if (stays.meets(g.position, g.radius, share)) {
      take_from_layer(g);
    } else {
      stays.add(g.position, g.radius);
    }
  }
}

double Zone::speed_along_x(int f, double raft) const {
  const RimFace& face = rim_.faces()[f];
  return face.axis() == 0 ? face.sign() * raft : slide_[f];
}

}  // namespace couloir
