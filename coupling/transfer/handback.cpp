#include "coupling/transfer/handback.hpp"

namespace couloir {

Handback::Handback(const Rim& rim, const ReferenceSurface& surface, double grain_density)
    : rim_(&rim), surface_(&surface), density_(grain_density) {
  for (const RimFace& face : rim.faces()) pending_.emplace_back(face.cells);
}

void Handback::mark_shadow(std::int64_t id) {
  if (id >= std::int64_t(shadow_.size())) shadow_.resize(2 * id + 1000, 0);
  shadow_[id] = 1;
}

void Handback::sort(const Grains& g, const std::vector<std::vector<Outside>>& outside, std::vector<std::int64_t>& remove,
                    const Flies& flies) {
  const double d = rim_->settings().diameter;
  const auto& faces = rim_->faces();
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (g.driven[i]) continue;
    const Vec p{g.x[i], g.y[i], g.z[i]};
    int at = -1;
    double distance = 0;  // the farthest out, where more than one face is passed
    for (int f = 0; f < int(faces.size()); ++f)
      if (const double s = faces[f].distance(p); s < distance) at = f, distance = s;

    const bool shadow = is_shadow(g.id[i]);
    if (at < 0 && !shadow) continue;
    if (!shadow && flies && flies(i)) {
      ++returned_;
      mark_shadow(g.id[i]);  // in the engine until the next window, but counted in the air
      remove.push_back(g.id[i]);
      continue;
    }

    const RimFace* face = at >= 0 ? &faces[at] : nullptr;
    if (at < 0) {  // a shadow has come back: through the face it is nearest to
      double nearest = 1e300;
      for (int f = 0; f < int(faces.size()); ++f)
        if (const double s = faces[f].distance(p); s < nearest) at = f, nearest = s;
      face = &faces[at];
    }
    const int cell = face->cell_at(face->along(p));
    const Outside& beyond = outside[at][face->segment_of_cell(cell)];

    const auto exchange = [&](double sign) {
      const double m = sign * grain_mass(g.radius[i], density_);
      const Eigen::Vector3d t = surface_->tangent(surface_->to_surface({p[0], p[1], p[2]}).x);
      Parcel& parcel = pending_[at][cell];
      parcel.mass += m;
      parcel.mom_x += m * (g.vx[i] * t.x() + g.vz[i] * t.z());
      parcel.mom_y += m * g.vy[i];
    };

    if (distance == 0) {  // the shadow inside again
      exchange(-1);
      shadow_[g.id[i]] = 0;
      --returned_;
    } else if (beyond.inflow) {
      if (distance > -d) continue;
      if (!shadow) {
        exchange(+1);
        ++returned_;
        mark_shadow(g.id[i]);  // still in the engine until the next window, but counted outside
      }
      remove.push_back(g.id[i]);
    } else {
      if (!shadow) {
        exchange(+1);
        ++returned_;
        mark_shadow(g.id[i]);
      }
      if (distance < -beyond.buffer) remove.push_back(g.id[i]);
    }
  }
}

double Handback::pending_mass() const {
  double sum = 0;
  for (const auto& face : pending_)
    for (const auto& p : face) sum += p.mass;
  return sum;
}

double Handback::pending_momentum() const {
  double sum = 0;
  for (const auto& face : pending_)
    for (const auto& p : face) sum += p.mom_x;
  return sum;
}

}  // namespace couloir
