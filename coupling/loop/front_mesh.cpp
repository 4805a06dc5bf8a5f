#include "coupling/loop/front_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/scene/stress_gauge.hpp"

namespace couloir {
namespace {

constexpr double same = 1e-9;      // shares of a length that are one line
constexpr double too_near = 0.25;  // of the size: between a node and a line that may as well be left out

// 0, 1 and the breaks, each once; between them as many as keep the gaps at most `size` [m], but for those too near to a node that
// is no line.
std::vector<double> lines(std::vector<double> breaks, const std::vector<double>& nodes, double length, double size) {
  breaks.push_back(0);
  breaks.push_back(1);
  std::ranges::sort(breaks);
  std::vector<double> out{0};
  for (double next : breaks) {
    const double last = out.back();
    if (next - last <= same) continue;
    if (1 - next <= same) next = 1;
    const int n = std::max(1, int(std::ceil(length * (next - last) / size - 1e-9)));
    for (int i = 1; i < n; ++i) {
      const double x = last + (next - last) * i / n;
      if (std::ranges::none_of(nodes, [&](double node) { return std::abs(node - x) * length < too_near * size; }))
        out.push_back(x);
    }
    out.push_back(next);
  }
  return out;
}

// The line that x is, bit for bit; or x.
double on_line(const std::vector<double>& lines, double x) {
  const double line = *std::ranges::min_element(lines, {}, [&](double l) { return std::abs(l - x); });
  return std::abs(line - x) <= 2 * same ? line : x;
}

// A gauge in shares of the face, the edges of its box on lines.
struct Placed {
  double left = 0, right = 0, low = 0, high = 0;
  double flat_left = 0, flat_right = 0, flat_low = 0, flat_high = 0;  // of a round one: ends of the sides on its square
  double x = 0, y = 0, rx = 0, ry = 0;                                // middle, and to the polygon's corners
  bool round = false;
  bool holds(double u, double v) const { return u > left && u < right && v > low && v < high; }
};

Placed placed(const StressGaugeSpec& g, const ObstacleSpec& o, const FrontMesh& mesh) {
  const GaugeBox b = gauge_box(g);
  const auto u = [&](double across) { return on_line(mesh.across, 0.5 + across / o.width); };
  const auto v = [&](double up) { return on_line(mesh.up, up / o.height); };
  Placed p;
  p.left = u(b.left), p.right = u(b.right), p.low = v(b.low), p.high = v(b.high);
  const double flat = gauge_flat(g), corner = std::hypot(0.5 * (b.right - b.left), flat);
  p.flat_left = u(g.across - flat), p.flat_right = u(g.across + flat);
  p.flat_low = v(g.up - flat), p.flat_high = v(g.up + flat);
  p.x = 0.5 + g.across / o.width, p.y = g.up / o.height;
  p.rx = corner / o.width, p.ry = corner / o.height;
  p.round = g.radius > 0;
  return p;
}

// Counter-clockwise from the lower end of the right flat side.
std::vector<FacePoint> polygon(const Placed& p) {
  std::vector<FacePoint> out;
  constexpr int quarter = gauge_sides / 4;
  const FacePoint flats[] = {{p.right, p.flat_low}, {p.right, p.flat_high}, {p.flat_right, p.high}, {p.flat_left, p.high},
                             {p.left, p.flat_high}, {p.left, p.flat_low},   {p.flat_left, p.low},   {p.flat_right, p.low}};
  for (int k = 0; k < gauge_sides; ++k) {
    if (k % quarter < 2) {
      out.push_back(flats[2 * (k / quarter) + k % quarter]);
    } else {
      const double angle = (2 * k - 1) * std::numbers::pi / gauge_sides;
      out.push_back({p.x + p.rx * std::cos(angle), p.y + p.ry * std::sin(angle)});
    }
  }
  return out;
}

// Nodes along a side of a box, rising: its ends, and what of the others lies between.
std::vector<double> nodes(double from, double to, const std::vector<double>& others) {
  std::vector<double> out{from, to};
  for (double x : others)
    if (x > from && x < to && std::ranges::count(out, x) == 0) out.push_back(x);
  std::ranges::sort(out);
  return out;
}

// The outline of a box, counter-clockwise from its lower left corner, from the nodes of its sides.
std::vector<FacePoint> outline(const std::vector<double>& low, const std::vector<double>& right, const std::vector<double>& high,
                               const std::vector<double>& left) {
  std::vector<FacePoint> out;
  const double u0 = low.front(), u1 = low.back(), v0 = left.front(), v1 = left.back();
  for (std::size_t k = 0; k + 1 < low.size(); ++k) out.push_back({low[k], v0});
  for (std::size_t k = 0; k + 1 < right.size(); ++k) out.push_back({u1, right[k]});
  for (std::size_t k = high.size() - 1; k > 0; --k) out.push_back({high[k], v1});
  for (std::size_t k = left.size() - 1; k > 0; --k) out.push_back({u0, left[k]});
  return out;
}

// The nodes on the square around a gauge.
std::vector<FacePoint> square(const Placed& p, const FrontMesh& mesh) {
  std::vector<double> us = mesh.across, vs = mesh.up;
  us.insert(us.end(), {p.flat_left, p.flat_right});
  vs.insert(vs.end(), {p.flat_low, p.flat_high});
  const std::vector<double> across = nodes(p.left, p.right, us), up = nodes(p.low, p.high, vs);
  return outline(across, up, across, up);
}

// Between the square and its polygon, corner by corner: from the end of a flat side all nodes up to the corner C see V2, and all
// from there to the next flat side V3.
//
//     V4--m---C
//      V3-    n
//        `V2  |
//          `--V1
void fill_corners(std::vector<FaceTriangle>& out, const std::vector<FacePoint>& outer, const std::vector<FacePoint>& polygon) {
  constexpr std::size_t quarter = gauge_sides / 4;
  for (std::size_t q = 0; q < 4; ++q) {
    const FacePoint &v1 = polygon[quarter * q + 1], &v2 = polygon[quarter * q + 2], &v3 = polygon[quarter * q + 3],
                    &v4 = polygon[(quarter * q + 4) % gauge_sides];
    const bool upright = q % 2 == 0;  // whether V1 lies on an upright side
    const FacePoint corner{upright ? v1[0] : v4[0], upright ? v4[1] : v1[1]};
    const FacePoint* seen_from = &v2;
    for (auto k = std::size_t(std::ranges::find(outer, v1) - outer.begin()); outer[k] != v4;) {
      if (outer[k] == corner) {
        out.push_back({v2, corner, v3});
        seen_from = &v3;
      }
      const std::size_t next = (k + 1) % outer.size();
      out.push_back({*seen_from, outer[k], outer[next]});
      k = next;
    }
  }
}

// A strip to and fro across a convex polygon.
void fill(std::vector<FaceTriangle>& out, const std::vector<FacePoint>& p) {
  std::size_t low = 0, high = p.size() - 1;
  for (bool up = true; high - low > 1; up = !up) {
    const std::size_t next = up ? low + 1 : high - 1;
    out.push_back({p[low], p[next], p[high]});
    (up ? low : high) = next;
  }
}

// A cell of the rest, with the ends of round gauges' sides that lie on its own.
void add_cell(std::vector<FaceTriangle>& out, const std::vector<Placed>& places, double u0, double u1, double v0, double v1) {
  std::vector<double> low, right, high, left;
  for (const Placed& p : places) {
    if (!p.round) continue;
    for (double u : {p.flat_left, p.flat_right}) {
      if (p.high == v0) low.push_back(u);
      if (p.low == v1) high.push_back(u);
    }
    for (double v : {p.flat_low, p.flat_high}) {
      if (p.left == u1) right.push_back(v);
      if (p.right == u0) left.push_back(v);
    }
  }
  const std::vector<FacePoint> rim = outline(nodes(u0, u1, low), nodes(v0, v1, right), nodes(u0, u1, high), nodes(v0, v1, left));
  if (rim.size() == 4) {
    out.push_back({rim[0], rim[1], rim[2]});
    out.push_back({rim[0], rim[2], rim[3]});
    return;
  }
  const FacePoint middle{0.5 * (u0 + u1), 0.5 * (v0 + v1)};
  for (std::size_t k = 0; k < rim.size(); ++k) out.push_back({middle, rim[k], rim[(k + 1) % rim.size()]});
}

}  // namespace

FrontMesh front_mesh(const ObstacleSpec& o, const std::vector<StressGaugeSpec>& gauges, double size) {
  FrontMesh mesh;
  std::vector<double> across, up, ends_across, ends_up;
  for (const StressGaugeSpec& g : gauges) {
    const GaugeBox b = gauge_box(g);
    for (double u : {b.left, b.right}) across.push_back(0.5 + u / o.width);
    for (double v : {b.low, b.high}) up.push_back(v / o.height);
    if (g.radius == 0) continue;
    for (double flat : {-gauge_flat(g), gauge_flat(g)}) {
      ends_across.push_back(0.5 + (g.across + flat) / o.width);
      ends_up.push_back((g.up + flat) / o.height);
    }
  }
  mesh.across = lines(across, ends_across, o.width, size);
  mesh.up = lines(up, ends_up, o.height, size);
  std::vector<Placed> places;
  for (const StressGaugeSpec& g : gauges) places.push_back(placed(g, o, mesh));
  mesh.gauges.resize(gauges.size());

  for (std::size_t i = 0; i + 1 < mesh.across.size(); ++i) {
    for (std::size_t j = 0; j + 1 < mesh.up.size(); ++j) {
      const double u0 = mesh.across[i], u1 = mesh.across[i + 1], v0 = mesh.up[j], v1 = mesh.up[j + 1];
      const auto of = std::ranges::find_if(places, [&](const Placed& p) { return p.holds(0.5 * (u0 + u1), 0.5 * (v0 + v1)); });
      if (of != places.end() && of->round) continue;
      auto& part = of == places.end() ? mesh.rest : mesh.gauges[std::size_t(of - places.begin())];
      add_cell(part, places, u0, u1, v0, v1);
    }
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!places[k].round) continue;
    const std::vector<FacePoint> corners = polygon(places[k]);
    fill_corners(mesh.rest, square(places[k], mesh), corners);
    fill(mesh.gauges[k], corners);
  }
  return mesh;
}

}  // namespace couloir
