#include "coupling/loop/meshes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "coupling/loop/front_mesh.hpp"

namespace couloir {
namespace {

using Point = std::function<Eigen::Vector3d(double a, double b)>;  // of two parameters in [0, 1]

Vec vec(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// A sheet of quadrilaterals between lines of both parameters, two triangles each.
void sheet(std::vector<Triangle>& out, const Point& at, const std::vector<double>& p, const std::vector<double>& q) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = 0; j + 1 < q.size(); ++j) {
      const Vec a = vec(at(p[i], q[j])), b = vec(at(p[i + 1], q[j]));
      const Vec c = vec(at(p[i + 1], q[j + 1])), d = vec(at(p[i], q[j + 1]));
      out.push_back({a, b, c});
      out.push_back({a, c, d});
    }
}

std::vector<double> even(int n) {
  std::vector<double> lines;
  for (int i = 0; i <= n; ++i) lines.push_back(double(i) / n);
  return lines;
}

void sheet(std::vector<Triangle>& out, const Point& at, int n, int m) {
  sheet(out, at, even(n), even(m));
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

// Shares of the way from x0 to x1 with an edge of the bed at each, so that none is longer than `size` and none leaves an arc by
// more than `off`: grains are laid on the arc itself, and would be pressed into a chord.
std::vector<double> along_the_bed(const ReferenceSurface& surface, double x0, double x1, double size, double off) {
  std::vector<double> ends{x0};
  for (const Arc& arc : surface.arcs())
    for (const double x : {arc.begin, arc.begin + arc.length})
      if (x > ends.back() + 0.1 * size && x < x1 - 0.1 * size) ends.push_back(x);  // no slivers
  ends.push_back(x1);
  std::vector<double> lines{0};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double bend = std::abs(surface.curvature(0.5 * (ends[k] + ends[k + 1])));
    const int n = pieces(ends[k + 1] - ends[k], bend > 0 ? std::min(size, std::sqrt(8 * off / bend)) : size);
    for (int i = 1; i <= n; ++i) lines.push_back((ends[k] + (ends[k + 1] - ends[k]) * i / n - x0) / (x1 - x0));
  }
  return lines;
}

}  // namespace

std::vector<Triangle> bed_mesh(const ReferenceSurface& surface, const Patch& p, double size) {
  std::vector<Triangle> out;
  sheet(
      out,
      [&](double a, double b) {
        return surface.to_space({p.x0 + a * (p.x1 - p.x0), p.y0 + b * (p.y1 - p.y0), 0});
      },
      along_the_bed(surface, p.x0, p.x1, size, 1e-3 * size), even(pieces(p.y1 - p.y0, size)));
  return out;
}

ObstacleMesh cuboid_mesh(const ReferenceSurface& surface, const ObstacleSpec& o, double size,
                         const std::vector<StressGaugeSpec>& gauges) {
  const double middle = o.x + 0.5 * o.length;
  const Eigen::Vector3d foot = surface.to_space({middle, o.y, 0}), t = surface.tangent(middle), n = surface.normal(middle);
  const Eigen::Vector3d along = o.length * t, across = o.width * Eigen::Vector3d::UnitY(), up = o.height * n;
  const Eigen::Vector3d corner = foot - 0.5 * along - 0.5 * across;
  const FrontMesh front = front_mesh(o, gauges, size);
  const auto on_front = [&](const std::vector<FaceTriangle>& flat) {
    const auto at = [&](const FacePoint& p) { return vec(corner + p[0] * across + p[1] * up); };
    std::vector<Triangle> out;
    for (const FaceTriangle& t : flat) out.push_back({at(t[0]), at(t[1]), at(t[2])});
    return out;
  };
  ObstacleMesh mesh{on_front(front.rest), {}};
  for (const auto& gauge : front.gauges) mesh.gauges.push_back(on_front(gauge));
  std::vector<Triangle>& out = mesh.rest;
  const std::vector<double> nl = even(pieces(o.length, size)), &nw = front.across, &nh = front.up;
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + along + a * across + b * up); }, nw, nh);  // downstream
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + a * along + b * up); }, nl, nh);  // left
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + across + a * along + b * up); }, nl, nh);  // right
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(corner + up + a * along + b * across); }, nl, nw);  // top
  return mesh;
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

// Rigid, its z axis along the normal at the middle of its box: on an arc it stands on the tangent plane there, as a cuboid does.
std::vector<Triangle> body_mesh(const ReferenceSurface& surface, const ObstacleSpec& o, double size) {
  const double middle = o.x + 0.5 * o.length;
  const Eigen::Vector3d foot = surface.to_space({middle, o.y, 0}), t = surface.tangent(middle), n = surface.normal(middle);
  const auto at = [&](const BodyPoint& p) {
    return vec(foot + (p[0] - 0.5 * o.length) * t + p[1] * Eigen::Vector3d::UnitY() + p[2] * n);
  };
  std::vector<Triangle> out;
  for (const BodyTriangle& b : cut_to_size(o.body->triangles(), size)) out.push_back({at(b[0]), at(b[1]), at(b[2])});
  return out;
}

ObstacleMesh obstacle_mesh(const ReferenceSurface& surface, const ObstacleSpec& o, double size,
                           const std::vector<StressGaugeSpec>& gauges) {
  if (o.shape == ObstacleSpec::Shape::tetrahedron) return {tetrahedron_mesh(surface, o, size), {}};
  if (o.shape == ObstacleSpec::Shape::mesh) return {body_mesh(surface, o, size), {}};
  return cuboid_mesh(surface, o, size, gauges);
}

Extent extent(const ReferenceSurface& surface, double x0, double x1, double height) {
  Extent e{surface.to_space({x0, 0, 0}), surface.to_space({x0, 0, 0})};
  const int stations = 64;
  for (int i = 0; i <= stations; ++i)
    for (const double n : {0.0, height}) {
      const Eigen::Vector3d p = surface.to_space({x0 + (x1 - x0) * i / stations, 0, n});
      e.lo = e.lo.cwiseMin(p), e.hi = e.hi.cwiseMax(p);
    }
  return e;
}

std::vector<Triangle> side_mesh(const ReferenceSurface& surface, double x0, double x1, double y, double height, double size) {
  std::vector<Triangle> out;
  const bool bends = std::ranges::any_of(surface.arcs(), [&](const Arc& a) { return x0 < a.begin + a.length && a.begin < x1; });
  if (!bends) {
    sheet(
        out,
        [&](double a, double b) {
          return surface.to_space({x0 + a * (x1 - x0), y, b * height});
        },
        pieces(x1 - x0, size), pieces(height, size));
    return out;
  }
  // Above an arc normals meet, and lines along them would cross: the rectangle around it all, which reaches below the bed.
  const auto [lo, hi] = extent(surface, x0, x1, height);
  sheet(
      out, [&](double a, double b) { return Eigen::Vector3d(lo.x() + a * (hi.x() - lo.x()), y, lo.z() + b * (hi.z() - lo.z())); },
      pieces(hi.x() - lo.x(), size), pieces(hi.z() - lo.z(), size));
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
