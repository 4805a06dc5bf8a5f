// Triangles as the surface of a body.

#include <fmt/format.h>

#include <map>

#include "coupling/scene/solid_body.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

std::string place(const BodyPoint& p) {
  const auto len = [](double x) { return short_quantity(x, Dimension::length); };
  return fmt::format("[{}, {}, {}]", len(p[0]), len(p[1]), len(p[2]));
}

double volume(const TriangleMesh& m) {
  const BodyPoint& o = m.vertices[m.faces[0][0]];
  double sum = 0;
  for (const auto& f : m.faces) {
    double e[3][3];
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) e[c][k] = m.vertices[f[c]][k] - o[k];
    sum += e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) + e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  }
  return sum / 6;
}

}  // namespace

TriangleMesh welded(const std::vector<BodyTriangle>& triangles) {
  TriangleMesh out;
  std::map<BodyPoint, int> numbers;
  for (const BodyTriangle& t : triangles) {
    std::array<int, 3> face{};
    for (int k = 0; k < 3; ++k) {
      const BodyPoint p{t[k][0] + 0.0, t[k][1] + 0.0, t[k][2] + 0.0};  // no -0
      const auto [at, added] = numbers.try_emplace(p, int(out.vertices.size()));
      if (added) out.vertices.push_back(p);
      face[k] = at->second;
    }
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) out.faces.push_back(face);
  }
  return out;
}

std::string flaw_of(const TriangleMesh& m) {
  if (m.faces.empty()) return "has no triangle with an extent; export it anew";
  std::map<std::pair<int, int>, int> edges;  // by direction: how many triangles
  for (const auto& f : m.faces)
    for (int k = 0; k < 3; ++k) ++edges[{f[k], f[(k + 1) % 3]}];
  int open = 0, turned = 0;
  std::pair<int, int> at_open, at_turned;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    const int backward = back == edges.end() ? 0 : back->second;
    if (count == backward) continue;
    if (count + backward > 1 && backward == 0) {
      if (turned++ == 0) at_turned = edge;
    } else if (count > backward) {
      if (open++ == 0) at_open = edge;
    }
  }
  const auto on = [&](const std::pair<int, int>& edge) {
    return fmt::format("{} to {}", place(m.vertices[edge.first]), place(m.vertices[edge.second]));
  };
  if (open > 0)
    return fmt::format("is open: {} {} no triangle on the other side, one from {}; close the surface, its base too", open,
                       open == 1 ? "edge has" : "edges have", on(at_open));
  if (turned > 0)
    return fmt::format(
        "has triangles that are turned against their neighbours, along {} {}, one from {}; turn them so that all look "
        "out of the body",
        turned, turned == 1 ? "edge" : "edges", on(at_turned));
  if (!(volume(m) > 0)) return "is turned inside out: its triangles look into the body; turn all of them";
  return "";
}

}  // namespace couloir
