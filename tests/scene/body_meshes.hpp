#pragma once
// Bodies for tests, in any unit.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "coupling/scene/solid_body.hpp"

namespace couloir {

// A prism along z over a convex polygon, from z0 to z1.
inline std::vector<BodyTriangle> prism(const std::vector<std::array<double, 2>>& polygon, double z0, double z1) {
  std::vector<BodyTriangle> out;
  const std::size_t n = polygon.size();
  const auto at = [&](std::size_t k, double z) { return BodyPoint{polygon[k % n][0], polygon[k % n][1], z}; };
  for (std::size_t k = 0; k < n; ++k) {
    out.push_back({at(k, z0), at(k + 1, z0), at(k + 1, z1)});
    out.push_back({at(k, z0), at(k + 1, z1), at(k, z1)});
  }
  for (std::size_t k = 2; k < n; ++k) {
    out.push_back({at(0, z1), at(k - 1, z1), at(k, z1)});
    out.push_back({at(0, z0), at(k, z0), at(k - 1, z0)});
  }
  return out;
}

inline std::vector<BodyTriangle> box(double x0, double x1, double y0, double y1, double z0, double z1) {
  return prism({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, z0, z1);
}

// Half of a ring, open to low x: a catching dam.
inline std::vector<BodyTriangle> half_ring(double inner, double outer, double height, int parts) {
  std::vector<BodyTriangle> out;
  const auto at = [&](int k, double r, double z) {
    const double a = -M_PI / 2 + M_PI * k / parts;
    return BodyPoint{r * std::cos(a), r * std::sin(a), z};
  };
  const auto quad = [&](BodyPoint a, BodyPoint b, BodyPoint c, BodyPoint d) {
    out.push_back({a, b, c});
    out.push_back({a, c, d});
  };
  for (int k = 0; k < parts; ++k) {
    quad(at(k, outer, 0), at(k + 1, outer, 0), at(k + 1, outer, height), at(k, outer, height));
    quad(at(k + 1, inner, 0), at(k, inner, 0), at(k, inner, height), at(k + 1, inner, height));
    quad(at(k, inner, height), at(k, outer, height), at(k + 1, outer, height), at(k + 1, inner, height));
    quad(at(k, outer, 0), at(k, inner, 0), at(k + 1, inner, 0), at(k + 1, outer, 0));
  }
  quad(at(0, inner, 0), at(0, outer, 0), at(0, outer, height), at(0, inner, height));
  quad(at(parts, outer, 0), at(parts, inner, 0), at(parts, inner, height), at(parts, outer, height));
  return out;
}

inline std::string stl_text(const std::vector<BodyTriangle>& triangles) {
  std::string out = "solid body\n";
  for (const BodyTriangle& t : triangles) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const BodyPoint& p : t) out += fmt::format("vertex {} {} {}\n", p[0], p[1], p[2]);
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid body\n";
}

}  // namespace couloir
