#include "continuum/terrain/reference_surface.hpp"

#include <algorithm>
#include <cmath>
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
  s.angle_ = angle, s.slope_ = slope, s.arc_ = arc, s.runout_ = runout;
  return s;
}

double ReferenceSurface::length() const {
  return slope_ + arc_ + runout_;
}

bool ReferenceSurface::curved() const {
  return arc_ > 0 && angle_ > 0;
}

double ReferenceSurface::arc_begin() const {
  return slope_;
}

double ReferenceSurface::arc_length() const {
  return curved() ? arc_ : 0.0;
}

double ReferenceSurface::angle(double x) const {
  if (x <= slope_ || arc_ + runout_ == 0) return angle_;
  return arc_ > 0 ? angle_ * std::max(0.0, 1 - (x - slope_) / arc_) : 0.0;
}

double ReferenceSurface::curvature(double x) const {
  return curved() && x > slope_ && x < slope_ + arc_ ? angle_ / arc_ : 0.0;
}

//            n
//   incline  |   the arc turns the tangent by theta = angle_ - zeta(x) about the centre (slope_, R),
//  __________|   R = arc_ / angle_; the run-out goes on along the last tangent
//            `-._
Eigen::Vector3d ReferenceSurface::tangent(double x) const {
  const double theta = angle_ - angle(x);
  return {std::cos(theta), 0, std::sin(theta)};
}

Eigen::Vector3d ReferenceSurface::normal(double x) const {
  const double theta = angle_ - angle(x);
  return {-std::sin(theta), 0, std::cos(theta)};
}

Eigen::Vector3d ReferenceSurface::to_space(const SurfacePoint& p) const {
  const double theta = angle_ - angle(p.x);
  const double radius = curved() ? arc_ / angle_ : 0;
  const double straight = std::min(p.x, arc_ + runout_ == 0 ? p.x : slope_);
  const double turned = curved() ? 0 : std::clamp(p.x - slope_, 0.0, arc_);  // an "arc" of angle 0 is straight
  const double beyond = arc_ + runout_ == 0 ? 0 : std::max(0.0, p.x - slope_ - arc_) + turned;
  const double chord = 2 * radius * std::sin(theta / 2);  // without the loss of 1 - cos
  return {straight + radius * std::sin(theta) + beyond * std::cos(theta) - p.n * std::sin(theta), p.y,
          chord * std::sin(theta / 2) + beyond * std::sin(theta) + p.n * std::cos(theta)};
}

SurfacePoint ReferenceSurface::to_surface(const Eigen::Vector3d& p) const {
  if (arc_ + runout_ == 0 || p.x() <= slope_) return {p.x(), p.y(), p.z()};
  if (curved()) {
    const double radius = arc_ / angle_;
    const double along = p.x() - slope_, down = radius - p.z();  // from the centre of the arc
    const double theta = std::atan2(along, down);
    if (theta <= angle_) return {slope_ + radius * theta, p.y(), radius - std::hypot(along, down)};
  }
  const double end = slope_ + arc_;
  const Eigen::Vector3d from_end = p - to_space({end, p.y(), 0});
  const Eigen::Vector3d t{std::cos(angle_), 0, std::sin(angle_)}, n{-std::sin(angle_), 0, std::cos(angle_)};
  return {end + from_end.dot(t), p.y(), from_end.dot(n)};
}

Eigen::Vector3d ReferenceSurface::gravity_direction() const {
  return {std::sin(angle_), 0, -std::cos(angle_)};
}

Eigen::Vector3d ReferenceSurface::to_level(const Eigen::Vector3d& p) const {
  const double c = std::cos(angle_), s = std::sin(angle_);
  return {c * p.x() + s * p.z(), p.y(), c * p.z() - s * p.x()};
}

}  // namespace couloir
