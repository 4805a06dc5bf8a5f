#include "coupling/loop/meshes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

namespace couloir {
namespace {

using Point = std::function<Eigen::Vector3d(double a, double b)>;  // of two parameters in [0, 1]

Vec vec(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// A sheet of n x m quadrilaterals, two triangles each.
void sheet(std::vector<Triangle>& out, const Point& at, int n, int m) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const Vec a = vec(at(double(i) / n, double(j) / m)), b = vec(at(double(i + 1) / n, double(j) / m));
      const Vec c = vec(at(double(i + 1) / n, double(j + 1) / m)), d = vec(at(double(i) / n, double(j + 1) / m));
      out.push_back({a, b, c});
      out.push_back({a, c, d});
    }
}

// One triangle cut into n x n alike, all of its orientation;
// row j along a - b holds n - j upright triangles and n - j - 1 turned ones
void facet(std::vector<Triangle>& out, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, int n) {
  const auto at = [&](int i, int j) { return vec(a + (b - a) * i / n + (c - a) * j / n); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i + j < n; ++i) {
      out.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 1 < n) out.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
}

int pieces(double length, double size) {
  return std::max(1, int(std::ceil(std::abs(length) / size - 1e-9)));
}

}  // namespace

std::vector<Triangle> bed_mesh(const ReferenceSurface& surface, const Patch& p, double size) {
  std::vector<Triangle> out;
  sheet(
      out,
      [&](double a, double b) {
        return surface.to_space({p.x0 + a * (p.x1 - p.x0), p.y0 + b * (p.y1 - p.y0), 0});
      },
      pieces(p.x1 - p.x0, size), pieces(p.y1 - p.y0, size));
  return out;
}

std::vector<Triangle> cuboid_mesh(const ReferenceSurface& surface, const ObstacleSpec& o, double size) {
  const double middle = o.x + 0.5 * o.length;
  const Eigen::Vector3d foot = surface.to_space({middle, o.y, 0}), t = surface.tangent(middle), n = surface.normal(middle);
  const Eigen::Vector3d along = o.length * t, across = o.width * Eigen::Vector3d::UnitY(), up = o.height * n;
  const Eigen::Vector3d corner = foot - 0.5 * along - 0.5 * across;
  const int nl = pieces(o.length, size), nw = pieces(o.width, size), nh = pieces(o.height, size);
  std::vector<Triangle> out;
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + a * across + b * up); }, nw, nh);  // upstream
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + along + a * across + b * up); }, nw, nh);  // downstream
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + a * along + b * up); }, nl, nh);  // left
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + across + a * along + b * up); }, nl, nh);  // right
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + up + a * along + b * across); }, nl, nw);  // top
  return out;
}

std::vector<Triangle> tetrahedron_mesh(const ReferenceSurface& surface, const ObstacleSpec& o, double size) {
  const double peak_x = o.crest_x();
  const Eigen::Vector3d foot = surface.to_space({peak_x, o.y, 0}), t = surface.tangent(peak_x), n = surface.normal(peak_x);
  const Eigen::Vector3d aside = 0.5 * o.width * Eigen::Vector3d::UnitY(), back = foot + (o.x + o.length - peak_x) * t;
  const Eigen::Vector3d front = foot - (peak_x - o.x) * t, left = back - aside, right = back + aside, peak = foot + o.height * n;
  const double longest = std::max({(left - front).norm(), (peak - front).norm(), (peak - left).norm(), o.width});
  const int parts = pieces(longest, size);
  std::vector<Triangle> out;
  facet(out, front, left, peak, parts);
  facet(out, right, front, peak, parts);
  facet(out, left, right, peak, parts);
  return out;
}

std::vector<Triangle> obstacle_mesh(const ReferenceSurface& surface, const ObstacleSpec& o, double size) {
  return o.shape == ObstacleSpec::Shape::tetrahedron ? tetrahedron_mesh(surface, o, size) : cuboid_mesh(surface, o, size);
}

std::vector<Triangle> side_mesh(const ReferenceSurface& surface, double x0, double x1, double y, double height, double size) {
  std::vector<Triangle> out;
  sheet(
      out,
      [&](double a, double b) {
        return surface.to_space({x0 + a * (x1 - x0), y, b * height});
      },
      pieces(x1 - x0, size), pieces(height, size));
  return out;
}

std::vector<Triangle> end_mesh(const ReferenceSurface& surface, double x, double y0, double y1, double height, double size) {
  std::vector<Triangle> out;
  sheet(
      out,
      [&](double a, double b) {
        return surface.to_space({x, y0 + a * (y1 - y0), b * height});
      },
      pieces(y1 - y0, size), pieces(height, size));
  return out;
}

}  // namespace couloir
