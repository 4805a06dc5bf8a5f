#include "coupling/study/likeness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "coupling/plan/build.hpp"
#include "coupling/plan/flow_estimate.hpp"

namespace couloir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), degree = std::numbers::pi / 180;

std::string kind_of(const ObstacleSpec& o, double width) {
  switch (o.shape) {
    case ObstacleSpec::Shape::tetrahedron:
      return "tetrahedron";
    case ObstacleSpec::Shape::mesh:
      return "mesh";
    default:
      return o.width >= width * (1 - 1e-9) ? "cuboid across" : "cuboid";
  }
}

// [m] of the first obstacle; without one the terrain's end.
double place_of(const Scene& scene) {
  return scene.obstacles.empty() ? scene.terrain.total_length()
                                 : std::ranges::min_element(scene.obstacles, {}, &ObstacleSpec::x)->x;
}

double ratio_term(double a, double b) {
  if (std::isnan(a) != std::isnan(b)) return 1;
  return std::isnan(a) ? 0 : std::pow(std::log(a / b), 2);
}

nlohmann::ordered_json number(double value) {
  return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

double number_from(const nlohmann::json& value) {
  return value.is_null() ? nan : value.get<double>();
}

}  // namespace

double depth_before(const Scene& scene) {
  return flow_estimate_at(scene, place_of(scene)).depth;
}

Likeness likeness(const Scene& scene) {
  Likeness out;
  const bool none = scene.obstacles.empty();
  const auto first = std::ranges::min_element(scene.obstacles, {}, &ObstacleSpec::x);
  const double x = place_of(scene);
  const FlowEstimate flow = flow_estimate_at(scene, x);
  const double d = scene.grains.diameter > 0 ? scene.grains.diameter : scene.material.diameter;
  out.froude = flow.froude > 0 ? flow.froude : nan;
  out.depth_over_height = none ? nan : flow.depth / first->height;
  out.depth_over_diameter = d > 0 ? flow.depth / d : nan;
  out.slope = reference_surface(scene).angle(x);
  out.obstacle = none ? "none" : kind_of(*first, scene.terrain.width);
  return out;
}

double distance(const Likeness& a, const Likeness& b) {
  return std::sqrt(ratio_term(a.froude, b.froude) + ratio_term(a.depth_over_height, b.depth_over_height) +
                   ratio_term(a.depth_over_diameter, b.depth_over_diameter) + std::pow((a.slope - b.slope) / (10 * degree), 2) +
                   (a.obstacle == b.obstacle ? 0 : 1));
}

std::string likeness_text(const Likeness& l) {
  std::string out = std::isnan(l.froude) ? "flow at rest" : fmt::format("Froude {:.2g}", l.froude);
  if (!std::isnan(l.depth_over_height)) out += fmt::format(", flow {:.2g} of the obstacle's height", l.depth_over_height);
  if (!std::isnan(l.depth_over_diameter)) out += fmt::format(", {:.2g} grains deep", l.depth_over_diameter);
  return out + fmt::format(", slope {:.3g} deg, obstacle {}", l.slope / degree, l.obstacle);
}

nlohmann::ordered_json likeness_json(const Likeness& l) {
  return {{"froude", number(l.froude)},
          {"depth_over_height", number(l.depth_over_height)},
          {"depth_over_diameter", number(l.depth_over_diameter)},
          {"slope", l.slope},
          {"obstacle", l.obstacle}};
}

Likeness likeness_from(const nlohmann::json& j) {
  return {number_from(j.at("froude")), number_from(j.at("depth_over_height")), number_from(j.at("depth_over_diameter")),
          j.at("slope").get<double>(), j.at("obstacle").get<std::string>()};
}

}  // namespace couloir
