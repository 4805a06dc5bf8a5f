#pragma once
// Obstacles as smooth bed heights z_b(x, y) above the reference surface, as (2.91), (2.92) know them.
//
//   cuboid (4.6)-(4.9)                          tetrahedron (4.1)-(4.5)
//
//          ____________                                   /|
//         /            \   height                        / |        height at the peak, above the centre
//     ___/              \___                         ___/  |___     of the base triangle
//
//       +---------------+                                     /|
//       |\_____________/|   y                                / |
//       | |    top    | |   ^                  upstream     /  | \            y
//       | |           | |   |                  corner      <---*  |  width    ^
//       |/-------------\|   +--> x             (x, y)       \  | /            |
//       +---------------+                                    \ |              +--> x
//       ramp         ramp                                     \|  length
//
// Both are a roof of planes, z_b = max(0, min_k plane_k), so z_b is continuous and its derivatives jump at the edges only. A
// surface is any other z_b.

#include <functional>
#include <string>
#include <vector>

namespace couloir {

// One body. Lengths in m, reference coordinates.
class ElevationBody {
 public:
  // A frustum on the base x0..x1, y0..y1 whose sides rise to `height` within `ramp`, so with the slope height / ramp; the top is
  // the base less `ramp` on each side. (4.6) has two ramps: (W_b - W_t)/2 along x, (L_b - L_t)/2 along y.
  // Throws std::invalid_argument where a length is not positive or a ramp is longer than half of the base.
  static ElevationBody cuboid(int obstacle, std::string name, double x0, double x1, double y0, double y1, double height,
                              double ramp_x, double ramp_y);

  // On an isosceles triangle with its corner (x, y) upstream and its edge of length `width` across the slope at x + length. The
  // peak stands above the centre of the base, at x + 2/3 length. The dissertation's base is equilateral: width L,
  // length sqrt(3) L / 2. Throws std::invalid_argument where a length is not positive.
  static ElevationBody tetrahedron(int obstacle, std::string name, double x, double y, double length, double width,
                                   double height);

  // Any z_b(x, y) on the base x0..x1, y0..y1, 0 beside it; `height` is its greatest value. Its slopes are taken over a
  // thousandth of the base. Throws std::invalid_argument where a length is not positive.
  static ElevationBody surface(int obstacle, std::string name, double x0, double x1, double y0, double y1, double height,
                               std::function<double(double x, double y)> z_b);

  int obstacle() const { return obstacle_; }  // number in the scene's list of obstacles
  const std::string& name() const { return name_; }
  double height() const { return height_; }

  double at(double x, double y) const;
  // Derivatives of z_b; at an edge half of the sum of the derivatives on both sides, as (4.4), (4.5), (4.8), (4.9) have it.
  double slope_x(double x, double y) const;
  double slope_y(double x, double y) const;

  // The base's bounding box.
  double x0() const { return x0_; }
  double x1() const { return x1_; }
  double y0() const { return y0_; }
  double y1() const { return y1_; }

 private:
  struct Plane {
    double x, y;    // a point where its height is 0
    double gx, gy;  // gradient
    double level;   // height at that point
  };
  ElevationBody(int obstacle, std::string name, double height, double x0, double x1, double y0, double y1);
  static double height_of(const Plane& p, double x, double y) { return p.level + (p.gx * (x - p.x) + p.gy * (y - p.y)); }
  double rise(double x, double y, double dx, double dy) const;  // one-sided derivative in the direction (dx, dy)

  int obstacle_;
  std::string name_;
  double height_, x0_, x1_, y0_, y1_;
  std::vector<Plane> planes_;
  std::function<double(double x, double y)> surface_;  // instead of planes
};

// All bodies of a scene. Where footprints overlap the higher one counts. Callable, so that it is a
// std::function<double(double x, double y)>.
class Elevation {
 public:
  void add(ElevationBody body) { bodies_.push_back(std::move(body)); }
  const std::vector<ElevationBody>& bodies() const { return bodies_; }
  bool empty() const { return bodies_.empty(); }

  double at(double x, double y) const;  // [m]; 0 beside the bodies
  double operator()(double x, double y) const { return at(x, y); }
  double slope_x(double x, double y) const;  // dz_b/dx of the body that obstacle_at() names
  double slope_y(double x, double y) const;
  int obstacle_at(double x, double y) const;  // number of the obstacle that stands there; -1: none

 private:
  const ElevationBody* highest(double x, double y) const;

  std::vector<ElevationBody> bodies_;
};

}  // namespace couloir
