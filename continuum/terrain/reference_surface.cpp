#include "continuum/terrain/reference_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace couloir {
namespace {

void require(bool good, const char* what, double value) {
  if (good) return;
  std::ostringstream text;
  text << "The reference surface needs " << what << ", but got " << value << "; correct the terrain.";
  throw std::invalid_argument(text.str());
}

}  // namespace

ReferenceSurface ReferenceSurface::flat(double length) {
  return incline(0, length);
}

ReferenceSurface ReferenceSurface::incline(double angle, double length) {
  return chute(angle, length, 0, 0);
}

ReferenceSurface ReferenceSurface::chute(double angle, double slope, double arc, double runout) {
  require(angle >= 0 && angle < 2 * std::atan(1.0), "an angle from 0 to below 90 deg (in rad)", angle);
  require(slope > 0, "a positive length of the slope", slope);
  require(arc >= 0, "a length of the arc that is not negative", arc);
  require(runout >= 0, "a length of the run-out that is not negative", runout);
  ReferenceSurface s;
  s.add(slope, angle, angle);
  s.add(arc, angle, 0);
  s.add(runout, 0, 0);
  return s;
}

ReferenceSurface ReferenceSurface::profile(const std::vector<ProfilePoint>& stations) {
  require(stations.size() >= 2, "two stations of its profile or more", double(stations.size()));
  require(stations.front().x == 0, "a profile that begins at 0", stations.front().x);
  double least = stations.front().angle, most = least;
  ReferenceSurface s;
  for (std::size_t k = 0; k < stations.size(); ++k) {
    require(std::abs(stations[k].angle) < std::numbers::pi / 2, "angles between -90 and 90 deg (in rad)", stations[k].angle);
    least = std::min(least, stations[k].angle), most = std::max(most, stations[k].angle);
    if (k == 0) continue;
    require(stations[k].x > stations[k - 1].x, "stations of its profile that rise in x", stations[k].x);
    s.add(stations[k].x - stations[k - 1].x, stations[k - 1].angle, stations[k].angle);
  }
  require(most - least <= std::numbers::pi / 2, "angles within 90 deg of each other (in rad)", most - least);
  return s;
}

// Straight pieces that go on as the one before do are one, without a seam.
void ReferenceSurface::add(double length, double angle, double next_angle) {
  if (length == 0) return;
  const double curvature = (angle - next_angle) / length;
  const double x = length_;
  length_ += length;
  if (!pieces_.empty()) {
    Piece& before = pieces_.back();
    if (curvature == 0 && before.curvature == 0 && before.angle == angle) {
      before.length += length;
      return;
    }
  }
  Piece piece{.x = x, .length = length, .angle = angle, .curvature = curvature, .along = {1, 0, 0}, .up = {0, 0, 1}};
  if (!pieces_.empty()) {
    const Eigen::Vector3d at = to_space({x, 0, 0});
    const double turned = pieces_.front().angle - angle;
    piece.at_x = at.x(), piece.at_z = at.z();
    piece.along = {std::cos(turned), 0, std::sin(turned)}, piece.up = {-std::sin(turned), 0, std::cos(turned)};
  }
  pieces_.push_back(piece);
  if (curvature != 0) arcs_.push_back({x, length, curvature});
}

// An end belongs to the piece before it.
const ReferenceSurface::Piece& ReferenceSurface::piece_at(double x) const {
  std::size_t k = 0;
  while (k + 1 < pieces_.size() && x > pieces_[k + 1].x) ++k;
  return pieces_[k];
}

double ReferenceSurface::length() const {
  return length_;
}

bool ReferenceSurface::curved() const {
  return !arcs_.empty();
}

const std::vector<Arc>& ReferenceSurface::arcs() const {
  return arcs_;
}

double ReferenceSurface::angle(double x) const {
  const Piece& p = piece_at(x);
  return p.angle - p.curvature * std::clamp(x - p.x, 0.0, p.length);
}

double ReferenceSurface::curvature(double x) const {
  const Piece& p = piece_at(x);
  return x > p.x && x < p.x + p.length ? p.curvature : 0.0;
}

Eigen::Vector3d ReferenceSurface::tangent(double x) const {
  const double turned = pieces_.front().angle - angle(x);
  return {std::cos(turned), 0, std::sin(turned)};
}

Eigen::Vector3d ReferenceSurface::normal(double x) const {
  const double turned = pieces_.front().angle - angle(x);
  return {-std::sin(turned), 0, std::cos(turned)};
}

//      up |   . centre, 1/kappa above (kappa < 0: below) where the piece begins
//         |  theta = kappa s
//         +-------- along
//           `-._
Eigen::Vector3d ReferenceSurface::to_space(const SurfacePoint& p) const {
  const Piece& piece = piece_at(p.x);
  const double s = p.x - piece.x, on = std::clamp(s, 0.0, piece.length), theta = piece.curvature * on;
  const double half = std::sin(theta / 2);
  double ahead = on, above = 0;
  if (piece.curvature != 0) ahead = std::sin(theta) / piece.curvature, above = 2 * half * half / piece.curvature;
  const double past = s - on;  // straight on beyond the ends
  ahead += past * std::cos(theta) - p.n * std::sin(theta), above += past * std::sin(theta) + p.n * std::cos(theta);
  return {piece.at_x + ahead * piece.along.x() + above * piece.up.x(), p.y,
          piece.at_z + ahead * piece.along.z() + above * piece.up.z()};
}

SurfacePoint ReferenceSurface::to_surface(const Eigen::Vector3d& p) const {
  const auto from = [&](const Piece& piece) {  // along it and above it
    const double dx = p.x() - piece.at_x, dz = p.z() - piece.at_z;
    return std::pair{dx * piece.along.x() + dz * piece.along.z(), dx * piece.up.x() + dz * piece.up.z()};
  };
  std::size_t k = 0;
  while (k + 1 < pieces_.size() && from(pieces_[k + 1]).first > 0) ++k;
  const Piece& piece = pieces_[k];
  const auto [ahead, above] = from(piece);
  if (piece.curvature == 0 || ahead <= 0) return {piece.x + ahead, p.y(), above};
  const double radius = 1 / piece.curvature, side = radius > 0 ? 1 : -1;
  const double arm = std::hypot(ahead, radius - above), turned = std::atan2(ahead, side * (radius - above));
  const double on = side * radius * turned;
  if (on <= piece.length) return {piece.x + on, p.y(), radius - side * arm};
  const double whole = piece.length / (side * radius);  // past the last piece's end: straight on
  return {piece.x + piece.length + arm * std::sin(turned - whole), p.y(), radius - side * arm * std::cos(turned - whole)};
}

Eigen::Vector3d ReferenceSurface::gravity_direction() const {
  const double angle = pieces_.front().angle;
  return {std::sin(angle), 0, -std::cos(angle)};
}

Eigen::Vector3d ReferenceSurface::to_level(const Eigen::Vector3d& p) const {
  const double c = std::cos(pieces_.front().angle), s = std::sin(pieces_.front().angle);
  return {c * p.x() + s * p.z(), p.y(), c * p.z() - s * p.x()};
}

}  // namespace couloir
