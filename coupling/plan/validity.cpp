#include "coupling/plan/validity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/plan/build.hpp"
#include "coupling/plan/flow_estimate.hpp"
#include "coupling/scene/release_shape.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double steepest = 45 * degree, most_curvature = 0.3, most_acceleration = 0.5, strongest_jump = 2, fewest_grains = 5,
                 tallest_release = 0.5, most_lift = 1;

// The steepest face that looks upstream, where it is at least as high as the flow is deep or half as high as the obstacle.
Turn turn_at(const SolidBody& body, double depth) {
  Turn out;
  for (const BodyTriangle& t : body.triangles()) {
    std::array<double, 3> u{}, v{};
    for (int k = 0; k < 3; ++k) u[k] = t[1][k] - t[0][k], v[k] = t[2][k] - t[0][k];
    const double nx = u[1] * v[2] - u[2] * v[1], ny = u[2] * v[0] - u[0] * v[2], nz = u[0] * v[1] - u[1] * v[0];
    const auto [low, high] = std::minmax({t[0][2], t[1][2], t[2][2]});
    if (nx >= 0 || high - low < 0.5 * std::min(depth, body.height())) continue;
    const double angle = std::atan2(std::hypot(nx, ny), nz);
    if (angle > out.angle) out = {angle, (high - low) / std::max(1e-12, std::tan(std::min(angle, 89.9 * degree)))};
  }
  return out;
}

ShallowTest at_most(const std::string& name, double value, double limit, double unit = 1, const char* word = "") {
  return {name, fmt::format("{:.2g}{}, limit {:.2g}{}", value / unit, word, limit / unit, word), value, limit, value <= limit};
}

void add_grains(ShallowVerdict& verdict, const Scene& scene, const FlowEstimate& flow) {
  const double d = scene.grains.diameter > 0 ? scene.grains.diameter : scene.material.diameter;
  if (d <= 0) return;
  const double count = flow.depth / d;
  verdict.tests.push_back({"depth over diameter", fmt::format("{:.2g}, at least {:.2g}", count, fewest_grains), count,
                           fewest_grains, count >= fewest_grains});
}

}  // namespace

Turn turn_at(const ObstacleSpec& o, double depth) {
  switch (o.shape) {
    case ObstacleSpec::Shape::mesh:
      return turn_at(*o.body, depth);
    case ObstacleSpec::Shape::tetrahedron: {
      // The edge from the upstream corner to the peak, above the base's centre: two thirds of its length downstream (4.2), (4.3).
      const double run = 2 * o.length / 3;
      return {std::atan2(o.height, run), run};
    }
    default:  // by elevation its sides rise within the ramp
      if (o.method == ObstacleSpec::Method::elevation && o.ramp > 0) return {std::atan2(o.height, o.ramp), o.ramp};
      return {std::numbers::pi / 2, 0};
  }
}

bool ShallowVerdict::holds() const {
  return std::ranges::all_of(tests, [](const ShallowTest& t) { return t.holds || t.name == "depth over diameter"; });
}

std::string ShallowVerdict::sentence() const {
  std::vector<std::string> kept, broken;
  for (const ShallowTest& t : tests) (t.holds ? kept : broken).push_back(t.name + " " + t.text);
  const auto list = [](const std::vector<std::string>& all) { return fmt::format("{}", fmt::join(all, "; ")); };
  if (!holds()) return fmt::format("fails at {}: {}{}", place, list(broken), kept.empty() ? "" : " (" + list(kept) + ")");
  return fmt::format("holds at {}: {}{}", place, list(kept), broken.empty() ? "" : "; but " + list(broken));
}

ShallowVerdict shallow_verdict(const Scene& scene, const ObstacleSpec& o) {
  const FlowEstimate flow = flow_estimate_at(scene, o.x);
  const Turn turn = turn_at(o, flow.depth);
  ShallowVerdict out{o.name, true, {}};
  out.tests.push_back(at_most("slope of its front", turn.angle, steepest, degree, " deg"));
  const double curvature = turn.angle * flow.depth / (turn.length + flow.depth);
  out.tests.push_back(at_most("curvature times depth", curvature, most_curvature));
  out.tests.push_back(
      at_most("acceleration along the normal", flow.froude * flow.froude * curvature, most_acceleration, 1, " g"));
  const double full = (std::sqrt(1 + 8 * flow.froude * flow.froude) - 1) / 2;
  const double over = flow.depth > 0 ? 1 + o.height / flow.depth : full;
  out.tests.push_back(at_most("jump before it", std::max(1.0, std::min(full, over)), strongest_jump, 1, " depths"));
  add_grains(out, scene, flow);
  return out;
}

std::vector<ShallowVerdict> shallow_verdicts(const Scene& scene) {
  std::vector<ShallowVerdict> out;
  for (const ObstacleSpec& o : scene.obstacles) out.push_back(shallow_verdict(scene, o));
  const std::vector<FlowEstimate> line = flow_estimate(scene);
  const double reached = line.back().x;
  const ReferenceSurface surface = reference_surface(scene);
  const std::vector<TerrainArc> arcs = scene.terrain.arcs();
  for (const TerrainArc& arc : arcs) {
    if (reached < arc.begin) break;
    const FlowEstimate flow = flow_estimate_at(scene, arc.begin);
    ShallowVerdict bend{
        arcs.size() == 1 ? "arc" : fmt::format("arc at {}", short_quantity(arc.begin, Dimension::length)), false, {}};
    bend.tests.push_back(at_most("curvature times depth", std::abs(arc.curvature()) * flow.depth, most_curvature));
    if (arc.turn < 0) {  // faster and steeper towards its end
      double lift = 0;
      for (const FlowEstimate& f : line)
        if (f.x >= arc.begin && f.x <= arc.begin + arc.length)
          lift = std::max(lift, -arc.curvature() * f.velocity * f.velocity / (scene.gravity * std::cos(surface.angle(f.x))));
      bend.tests.push_back(at_most("lift over weight", lift, most_lift));
    }
    add_grains(bend, scene, flow);
    out.push_back(bend);
  }
  using Kind = ReleaseSpec::Kind;
  if (scene.release.kind != Kind::uniform && scene.release.kind != Kind::none) {
    const Footprint base = release_footprint(scene);
    ShallowVerdict release{"the release", false, {}};
    release.tests.push_back(at_most("depth over length", deepest(scene) / (base.x1 - base.x0), tallest_release));
    out.push_back(release);
  }
  return out;
}

}  // namespace couloir
