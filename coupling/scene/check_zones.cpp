#include "coupling/scene/check_zones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

// Grain diameters that a box must leave: before an obstacle, beside and behind it, before its own upstream face, where the driven
// layer lies, and to another box, whose layers and buffers lie between.
constexpr double zone_before = 5, zone_around = 2, driven_layer = 3, zone_apart = 30;

std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

struct ZoneChecker {
  const Scene& scene;
  const ZoneBox& z;
  std::string key;  // of the box
  double d = scene.grains.diameter, length = scene.terrain.total_length(), half = scene.terrain.width / 2;
  double room = 1e-9 * (length + 2 * half);  // for round-off

  template <class... Args>
  [[noreturn]] void fail(const std::string& member, fmt::format_string<Args...> text, Args&&... args) const {
    throw SceneError(
        fmt::format("{}: {} {}", scene.places.of(key + member), key + member, fmt::format(text, std::forward<Args>(args)...)));
  }

  void box() const {
    if (z.x1 <= z.x0 || z.y1 <= z.y0) {
      fail("", "is empty: x from {} to {}, y from {} to {}; give [from, to] with from below to", len(z.x0), len(z.x1), len(z.y0),
           len(z.y1));
    }
    if (z.x0 < -room || z.x1 > length + room || z.y0 < -half - room || z.y1 > half + room) {
      fail("", "reaches out of the domain (x from 0 to {}, y from {} to {})", len(length), len(-half), len(half));
    }
    if (z.x1 - z.x0 < zone_before * d || z.y1 - z.y0 < zone_around * d) {
      fail("", "is {} by {}, too small for grains of {}: at least {} diameters along and {} across", len(z.x1 - z.x0),
           len(z.y1 - z.y0), len(d), zone_before, zone_around);
    }
    if (z.x0 < driven_layer * d) {
      fail(".x", "starts at {}: upstream of the zone the driven layer of grains needs {} diameters ({})", len(z.x0), driven_layer,
           len(driven_layer * d));
    }
  }

  void around(const ObstacleSpec& o) const {
    const double x1 = o.x + o.length, y0 = o.y - o.width / 2, y1 = o.y + o.width / 2;
    if (z.apart(o)) return;  // the continuum keeps this one; the plan says so
    if (!z.holds(o)) {
      fail("", "cuts through obstacles.{} (x from {} to {}, y from {} to {}); it must hold it whole", o.name, len(o.x), len(x1),
           len(y0), len(y1));
    }
    const auto near = [&](double gap, double diameters, bool at_side) { return !at_side && gap < diameters * d - room; };
    const bool low = z.y0 <= -half + room, high = z.y1 >= half - room;
    if (near(o.x - z.x0, zone_before, false) || near(z.x1 - x1, zone_around, z.x1 >= length - room) ||
        near(y0 - z.y0, zone_around, low) || near(z.y1 - y1, zone_around, high)) {
      fail("", "is too tight around obstacles.{}: it needs {} grain diameters ({}) before it and {} beside and behind it", o.name,
           zone_before, len(zone_before * d), zone_around);
    }
  }

  void clear_of(const ZoneBox& other, const std::string& other_key) const {
    const bool periodic = scene.sides[2].kind == SideSpec::Kind::periodic;
    double gap = std::numeric_limits<double>::infinity();
    for (const double shift : {-2 * half, 0.0, 2 * half}) {
      if (shift != 0 && !periodic) continue;
      gap = std::min(gap, std::max({other.x0 - z.x1, z.x0 - other.x1, other.y0 + shift - z.y1, z.y0 - other.y1 - shift}));
    }
    if (gap >= zone_apart * d - room) return;
    fail("", "is {} {}: zones need {} grain diameters ({}) between them{}; move them apart, or give one box around both",
         gap > room ? "only " + len(gap) + " from" : "no way from", other_key, zone_apart, len(zone_apart * d),
         periodic ? ", also across periodic sides" : "");
  }
};

}  // namespace

void check_zones(const Scene& scene) {
  if (scene.mode != Mode::coupled) return;
  const std::vector<ZoneBox>& boxes = scene.grains.zones;
  if (boxes.empty()) {
    if (!scene.obstacles.empty()) return;
    throw SceneError(
        fmt::format("{}: grains.zone is auto, but there is no obstacle to put it around; give a box {{x: [.., ..], y: [.., ..]}} "
                    "or an obstacle",
                    scene.places.of("grains.zone")));
  }
  if (scene.places.has("grains.zones") && scene.places.has("grains.zone.x")) {
    throw SceneError(fmt::format("{}: grains.zones gives boxes, and grains.zone one more; put them all into grains.zones",
                                 scene.places.of("grains.zones")));
  }
  const auto key_of = [&](std::size_t n) {
    return scene.places.has("grains.zones") ? fmt::format("grains.zones[{}]", n) : std::string("grains.zone");
  };
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const ZoneChecker check{scene, boxes[n], key_of(n)};
    check.box();
    for (const ObstacleSpec& o : scene.obstacles) check.around(o);
    for (std::size_t m = 0; m < n; ++m) check.clear_of(boxes[m], key_of(m));
  }
  const auto held = [&](const ObstacleSpec& o) {
    return std::ranges::any_of(boxes, [&](const ZoneBox& z) { return z.holds(o); });
  };
  if (!scene.obstacles.empty() && !std::ranges::any_of(scene.obstacles, held)) {
    const bool one = boxes.size() == 1;
    const std::string key = one ? key_of(0) : "grains.zones";
    throw SceneError(fmt::format("{}: {} {} of the scene's obstacles; move {}, or use zone: auto", scene.places.of(key), key,
                                 one ? "holds none" : "hold none", one ? "it" : "one of them"));
  }
}

}  // namespace couloir
