// The driven layers before a zone's faces (zone.hpp): what stands there, what is lent to them, what leaves them.

#include <algorithm>
#include <cmath>
#include <set>

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
  const double width = grid_.ny * grid_.dy;
  return settings_.periodic_y ? dy - width * std::round(dy / width) : dy;
}

void Zone::find_layer(const Grains& g) {
  layer_.clear();
  beside_.clear();
  for (std::size_t i = 0; i < g.size(); ++i) {
    const Vec p{g.x[i], g.y[i], g.z[i]};
    if (!g.driven[i]) {
      if (is_beside_sliding_face(p)) beside_.push_back({g.id[i], p, {}, g.radius[i]});
      continue;
    }
    const int f = face_of_driven_[g.id[i]];
    const RimFace& face = rim_.faces()[f];
    layer_.push_back(
        {g.id[i], p, {g.vx[i], g.vy[i], g.vz[i]}, g.radius[i], f, face.segment_of_cell(face.cell_at(face.along(p)))});
  }
}

bool Zone::is_beside_sliding_face(const Vec& p) const {
  const double d = settings_.rim.diameter;
  for (int f = 0; f < int(rim_.faces().size()); ++f)
    if (slide_[f] != 0)
      if (const double s = rim_.faces()[f].distance(p); s > -rim_.layer() - d && s < d) return true;
  return false;
}

void Zone::note_driven(const NewGrain& g) {
  if (g.id >= std::int64_t(face_of_driven_.size())) face_of_driven_.resize(2 * g.id + 1000, -1);
  face_of_driven_[g.id] = char(g.face);
}

bool Zone::open_end(int f, int s) const {
  if (slide_[f] == 0) return false;
  const int beyond = slide_[f] > 0 ? s - 1 : s + 1;
  return beyond < 0 || beyond >= int(segments_[f].size()) || !segments_[f][beyond].inflow;
}

double Zone::Loan::repay(double m) {
  const double paid = std::min(mass, m);
  if (mass > 0) momentum -= momentum * paid / mass;
  mass -= paid;
  return m - paid;
}

// Driven grains where the flow has turned away never came in, and those that have slid past their face's end, or before a segment
// without a raft, will not. They go, beyond what is lent as flow outside, and what is owed where the flow has turned away with
// them.
void Zone::let_go_of_layer() {
  std::set<std::pair<int, int>> departed;
  for (const NewGrain& g : layer_) {
    const RimFace& face = rim_.faces()[g.face];
    const double along = face.along(g.position);
    const bool past_end = (slide_[g.face] > 0 && along >= face.extent()) || (slide_[g.face] < 0 && along < 0);
    const bool inflow = segments_[g.face][g.segment].inflow;
    if (inflow && !past_end) continue;
    if (!inflow) departed.insert({g.face, g.segment});
    remove_.push_back(g.id);
    handback_.mark_shadow(g.id);
    const double mass = by_ends_[g.face].repay(table_->grain_mass(g.radius));
    const Eigen::Vector3d t = surface_->tangent(surface_->to_surface({g.position[0], g.position[1], g.position[2]}).x);
    Parcel& parcel = handback_.pending()[g.face][face.cell_at(along)];
    parcel.mass += mass;
    parcel.mom_x += mass * (g.velocity[0] * t.x() + g.velocity[2] * t.z());
    parcel.mom_y += mass * g.velocity[1];
  }
  for (const auto& [f, s] : departed) {
    const RimFace& face = rim_.faces()[f];
    const int middle = std::min(face.cells - 1, s * face.cells_per_segment + face.cells_per_segment / 2);
    handback_.pending()[f][middle].mass += conveyors_[f].owed(s);
    conveyors_[f].owe(s, -conveyors_[f].owed(s));
  }
}

// Rafts of one face that move at different velocities push their grains into each other, and what is freed so is shot away: the
// later of two goes, and is owed again.
void Zone::thin_out_layer() {
  constexpr double share = 0.9;  // of the sum of the radii
  GrainBins stays(1.25 * settings_.rim.diameter);
  const double width = settings_.periodic_y ? grid_.ny * grid_.dy : 0;
  const auto meets = [&](const NewGrain& g) {
    for (const double image : {0.0, width, -width})
      if (stays.meets({g.position[0], g.position[1] + image, g.position[2]}, g.radius, share)) return true;
    return false;
  };
  for (const NewGrain& g : layer_) {
    if (std::binary_search(remove_.begin(), remove_.end(), g.id)) continue;
    if (!meets(g)) {
      stays.add(g.position, g.radius);
      continue;
    }
    remove_.push_back(g.id);
    handback_.mark_shadow(g.id);
    conveyors_[g.face].owe(g.segment, table_->grain_mass(g.radius));
  }
}

double Zone::speed_along_x(int f, double raft) const {
  const RimFace& face = rim_.faces()[f];
  return face.axis() == 0 ? face.sign() * raft : slide_[f];
}

}  // namespace couloir
