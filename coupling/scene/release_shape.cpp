#include "coupling/scene/release_shape.hpp"

#include <cmath>
#include <numbers>

namespace couloir {
namespace {

using Kind = ReleaseSpec::Kind;

bool on_obstacle(const Scene& scene, double x, double y) {
  for (const ObstacleSpec& o : scene.obstacles) {
    if (o.covers(x, y)) return true;
  }
  return false;
}

}  // namespace

Footprint release_footprint(const Scene& scene) {
  const ReleaseSpec& r = scene.release;
  switch (r.kind) {
    case Kind::cap:
      return {r.x - r.base_radius, r.x + r.base_radius, r.y - r.base_radius, r.y + r.base_radius};
    case Kind::ellipsoid:
      return {r.x - r.semi_x, r.x + r.semi_x, r.y - r.semi_y, r.y + r.semi_y};
    case Kind::block:
      return {r.x, r.x + r.length, r.y - r.width / 2, r.y + r.width / 2};
    case Kind::none:
      return {0, 0, 0, 0};
    case Kind::uniform:
      break;
  }
  return {0, scene.terrain.total_length(), -scene.terrain.width / 2, scene.terrain.width / 2};
}

double shape_volume(const Scene& scene) {
  constexpr double pi = std::numbers::pi;
  const ReleaseSpec& r = scene.release;
  switch (r.kind) {
    case Kind::cap:
      return pi * r.height * (3 * r.base_radius * r.base_radius + r.height * r.height) / 6;
    case Kind::ellipsoid:
      return 2 * pi / 3 * r.semi_x * r.semi_y * r.semi_z;
    case Kind::block:
      return r.length * r.width * r.height;
    case Kind::none:
      return 0;
    case Kind::uniform:
      break;
  }
  double area = scene.terrain.total_length() * scene.terrain.width;
  for (const ObstacleSpec& o : scene.obstacles) area -= o.base_area();
  return area * r.height;
}

double shape_depth(const Scene& scene, double x, double y) {
  const ReleaseSpec& r = scene.release;
  const double dx = x - r.x, dy = y - r.y;
  switch (r.kind) {
    case Kind::cap: {
      const double a2 = r.base_radius * r.base_radius, s2 = dx * dx + dy * dy;
      if (s2 >= a2) return 0;
      const double radius = (a2 + r.height * r.height) / (2 * r.height);
      // The sphere's middle lies radius - height below the surface, also where the cap is more than half a sphere.
      return std::max(0.0, std::sqrt(radius * radius - s2) - (radius - r.height));
    }
    case Kind::ellipsoid: {
      const double px = dx / r.semi_x, py = dy / r.semi_y, s2 = px * px + py * py;
      return s2 < 1 ? r.semi_z * std::sqrt(1 - s2) : 0;
    }
    case Kind::block:
      return dx >= 0 && dx < r.length && std::abs(dy) <= r.width / 2 ? r.height : 0;
    case Kind::none:
      return 0;
    case Kind::uniform:
      return on_obstacle(scene, x, y) ? 0 : r.height;
  }
  return 0;
}

double depth_scale(const Scene& scene) {
  return scene.release.mass == 0 ? 1 : scene.release.mass / (scene.material.density * shape_volume(scene));
}

double deepest(const Scene& scene) {
  const ReleaseSpec& r = scene.release;
  return depth_scale(scene) * (r.kind == Kind::ellipsoid ? r.semi_z : r.height);
}

}  // namespace couloir
