#include "continuum/terrain/elevation.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace couloir {
namespace {

constexpr double on_edge = 1e-9;  // share of the height: two planes that near to each other meet

void require(bool good, const std::string& name, const char* sentence, double value) {
  if (good) return;
  std::ostringstream text;
  text << "The obstacle '" << name << "' " << sentence << ", but got " << value << " m; correct its size.";
  throw std::invalid_argument(text.str());
}

}  // namespace

ElevationBody::ElevationBody(int obstacle, std::string name, double height, double x0, double x1, double y0, double y1)
    : obstacle_(obstacle), name_(std::move(name)), height_(height), x0_(x0), x1_(x1), y0_(y0), y1_(y1) {
  require(x1 > x0, name_, "needs a positive length", x1 - x0);
  require(y1 > y0, name_, "needs a positive width", y1 - y0);
  require(height > 0, name_, "needs a positive height", height);
}

ElevationBody ElevationBody::cuboid(int obstacle, std::string name, double x0, double x1, double y0, double y1, double height,
                                    double ramp_x, double ramp_y) {
  ElevationBody body(obstacle, std::move(name), height, x0, x1, y0, y1);
  const double room = 1 + 1e-12;
  require(ramp_x > 0 && 2 * ramp_x <= room * (x1 - x0), body.name_, "needs a ramp of at most half of its length", ramp_x);
  require(ramp_y > 0 && 2 * ramp_y <= room * (y1 - y0), body.name_, "needs a ramp of at most half of its width", ramp_y);
  const double slope_x = height / ramp_x, slope_y = height / ramp_y;
  body.planes_ = {{x0, y0, slope_x, 0, 0},
                  {x1, y0, -slope_x, 0, 0},
                  {x0, y0, 0, slope_y, 0},
                  {x0, y1, 0, -slope_y, 0},
                  {x0, y0, 0, 0, height}};
  return body;
}

ElevationBody ElevationBody::tetrahedron(int obstacle, std::string name, double x, double y, double length, double width,
                                         double height) {
  ElevationBody body(obstacle, std::move(name), height, x, x + length, y - width / 2, y + width / 2);
  const double up = 1.5 * height / length, aside = 3 * height / width;
  body.planes_ = {{x, y, up, aside, 0}, {x, y, up, -aside, 0}, {x + length, y, -2 * up, 0, 0}};
  return body;
}

ElevationBody ElevationBody::surface(int obstacle, std::string name, double x0, double x1, double y0, double y1, double height,
                                     std::function<double(double x, double y)> z_b) {
  ElevationBody body(obstacle, std::move(name), height, x0, x1, y0, y1);
  body.surface_ = std::move(z_b);
  return body;
}

double ElevationBody::at(double x, double y) const {
  if (surface_) return x >= x0_ && x <= x1_ && y >= y0_ && y <= y1_ ? std::max(0.0, surface_(x, y)) : 0.0;
  double least = height_;
  for (const Plane& p : planes_) least = std::min(least, height_of(p, x, y));
  return std::max(0.0, least);
}

double ElevationBody::rise(double x, double y, double dx, double dy) const {
  if (surface_) {
    const double far = 1e-3 * std::min(x1_ - x0_, y1_ - y0_);
    return (at(x + far * dx, y + far * dy) - at(x, y)) / far;
  }
  const double near = on_edge * height_;
  double least = std::numeric_limits<double>::infinity();
  for (const Plane& p : planes_) least = std::min(least, height_of(p, x, y));
  if (least < -near) return 0;
  double rise = std::numeric_limits<double>::infinity();
  for (const Plane& p : planes_) {
    if (height_of(p, x, y) <= least + near) rise = std::min(rise, p.gx * dx + p.gy * dy);
  }
  return least <= near ? std::max(0.0, rise) : rise;
}

double ElevationBody::slope_x(double x, double y) const {
  return 0.5 * (rise(x, y, 1, 0) - rise(x, y, -1, 0));
}

double ElevationBody::slope_y(double x, double y) const {
  return 0.5 * (rise(x, y, 0, 1) - rise(x, y, 0, -1));
}

// The edge of a base belongs to its body: there z_b is 0 but the averaged slope is not.
const ElevationBody* Elevation::highest(double x, double y) const {
  const ElevationBody* found = nullptr;
  for (const ElevationBody& b : bodies_) {
    const double here = b.at(x, y);
    const bool stands = here > 0 || b.slope_x(x, y) != 0 || b.slope_y(x, y) != 0;
    if (stands && (!found || here > found->at(x, y))) found = &b;
  }
  return found;
}

double Elevation::at(double x, double y) const {
  double most = 0;
  for (const ElevationBody& b : bodies_) most = std::max(most, b.at(x, y));
  return most;
}

double Elevation::slope_x(double x, double y) const {
  const ElevationBody* b = highest(x, y);
  return b ? b->slope_x(x, y) : 0;
}

double Elevation::slope_y(double x, double y) const {
  const ElevationBody* b = highest(x, y);
  return b ? b->slope_y(x, y) : 0;
}

int Elevation::obstacle_at(double x, double y) const {
  const ElevationBody* b = highest(x, y);
  return b ? b->obstacle() : -1;
}

}  // namespace couloir
