#include "coupling/scene/check_gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/stress_gauge.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

// [d] between two lines of a face's mesh: closer ones make triangles so thin that the engine leaves them out.
constexpr double least_gap = 0.1;

std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

// Of a face: 0 and its lengths are lines of its mesh as well.
struct Face {
  double left = 0, right = 0, low = 0, high = 0;  // [m]
  double room = 0;                                // [m] for round-off
};

Face face_of(const ObstacleSpec& o) {
  return {-o.width / 2, o.width / 2, 0, o.height, 1e-9 * (o.width + o.height)};
}

struct GaugeChecker {
  const Scene& scene;
  const StressGaugeSpec& gauge;
  const ObstacleSpec& obstacle;

  template <class... Args>
  [[noreturn]] void fail(const std::string& member, fmt::format_string<Args...> text, Args&&... args) const {
    const std::string key = gauge_key(scene, gauge) + member;
    throw SceneError(fmt::format("{}: {} {}", scene.places.of(key), key, fmt::format(text, std::forward<Args>(args)...)));
  }

  bool grains() const { return scene.mode != Mode::continuum; }

  void shape() const {
    if (obstacle.shape != ObstacleSpec::Shape::cuboid) {
      const bool wedge = obstacle.shape == ObstacleSpec::Shape::tetrahedron;
      fail("", "is on a {}, which has no face across the flow; stress gauges belong to cuboids, so leave it out",
           wedge ? "tetrahedron" : "mesh");
    }
    const bool rectangle = gauge.width > 0, round = gauge.radius > 0;
    if (rectangle && round) fail("", "has a size and a radius; keep the size of a rectangle or the radius of a round one");
    if (!rectangle && !round) fail("", "has no extent; give size: [across, up] of a rectangle, or the radius of a round one");
  }

  void within_face() const {
    const Face f = face_of(obstacle);
    const GaugeBox b = gauge_box(gauge);
    if (b.left < f.left - f.room || b.right > f.right + f.room || b.low < f.low - f.room || b.high > f.high + f.room) {
      fail("", "covers {} to {} across and {} to {} up, which reaches out of the face of {} ({} to {} across, {} to {} up)",
           len(b.left), len(b.right), len(b.low), len(b.high), obstacle.name, len(f.left), len(f.right), len(f.low), len(f.high));
    }
  }

  void holds_a_grain() const {
    const GaugeBox b = gauge_box(gauge);
    const double least = std::min(b.right - b.left, b.high - b.low), largest = scene.grains.diameter * (1 + scene.grains.spread);
    if (!grains() || least >= largest) return;
    fail("",
         "is only {} wide, less than the largest grain ({}): it would show single contacts and no stress; enlarge it, or use "
         "smaller grains",
         len(least), len(largest));
  }

  void apart_from(const StressGaugeSpec& other) const {
    const GaugeBox a = gauge_box(gauge), b = gauge_box(other);
    const double room = face_of(obstacle).room;
    if (a.left >= b.right - room || b.left >= a.right - room || a.low >= b.high - room || b.low >= a.high - room) return;
    const bool round = gauge.radius > 0 || other.radius > 0;
    fail("", "overlaps gauge {} of {}{}; move one of them", other.name, obstacle.name,
         round ? " (a round one is taken with the square around it)" : "");
  }

  // Lines of the mesh must be the same or clear of one another, and of the ends of a round gauge's sides on them.
  void clear_of_face(int direction) const {
    const Face f = face_of(obstacle);
    clear(direction, lines(gauge, direction, false), {direction == 0 ? f.left : f.low, direction == 0 ? f.right : f.high},
          nullptr);
  }

  void clear_of(const StressGaugeSpec& other, int direction) const {
    clear(direction, lines(gauge, direction, true), lines(other, direction, false), &other);
    clear(direction, lines(gauge, direction, false), lines(other, direction, true), &other);
  }

  static std::vector<double> lines(const StressGaugeSpec& g, int direction, bool with_ends) {
    const GaugeBox b = gauge_box(g);
    const double middle = direction == 0 ? g.across : g.up, flat = gauge_flat(g);
    std::vector<double> out{direction == 0 ? b.left : b.low, direction == 0 ? b.right : b.high};
    if (with_ends && g.radius > 0) out.insert(out.end(), {middle - flat, middle + flat});
    return out;
  }

  void clear(int direction, const std::vector<double>& own_lines, const std::vector<double>& others,
             const StressGaugeSpec* other) const {
    const Face f = face_of(obstacle);
    const double gap = least_gap * scene.grains.diameter;
    for (const double own : own_lines) {
      for (const double line : others) {
        const double distance = std::abs(own - line);
        if (!grains() || distance <= f.room || distance >= gap) continue;
        const std::string what = other ? "of gauge " + other->name : "of the face";
        fail("",
             "has its outline at {} {}, only {} beside an edge {}: no mesh has triangles as thin; let both coincide, or keep {} "
             "between them",
             len(own), direction == 0 ? "across" : "up", len(distance), what, len(gap));
      }
    }
  }
};

}  // namespace

void check_stress_gauges(const Scene& scene) {
  for (std::size_t n = 0; n < scene.stress_gauges.size(); ++n) {
    const StressGaugeSpec& g = scene.stress_gauges[n];
    const GaugeChecker check{scene, g, scene.obstacles[static_cast<std::size_t>(g.obstacle)]};
    check.shape();
    check.within_face();
    check.holds_a_grain();
    for (int direction : {0, 1}) check.clear_of_face(direction);
    for (std::size_t m = 0; m < n; ++m) {
      const StressGaugeSpec& other = scene.stress_gauges[m];
      if (other.obstacle != g.obstacle) continue;
      check.apart_from(other);
      for (int direction : {0, 1}) check.clear_of(other, direction);
    }
  }
}

}  // namespace couloir
