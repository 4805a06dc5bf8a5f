#include "random_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace couloir {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed * 0x9e3779b97f4a7c15ull) {}
  // The standard's distributions differ between libraries.
  double unit() { return double(engine_() >> 11) * 0x1p-53; }
  double from(double a, double b) { return a + (b - a) * unit(); }
  int whole(int a, int b) { return a + int(unit() * (b - a + 1)); }
  bool chance(double p) { return unit() < p; }
  template <class T>
  T one_of(std::initializer_list<T> all) {
    return *(all.begin() + whole(0, int(all.size()) - 1));
  }

 private:
  std::mt19937_64 engine_;
};

// All lengths in mm, in the file as well.
struct Draw {
  Dice dice;
  std::string text;
  double d = 0, cell = 0, length = 0, half = 0;
  double release_end = 0, depth = 0;
  double first = 0, last = 0, low = 0, high = 0;  // of the obstacles
  bool periodic = false, walls = false, obstacle = false;

  explicit Draw(std::uint64_t seed) : dice(seed) {}

  template <class... Args>
  void line(fmt::format_string<Args...> form, Args&&... args) {
    text += fmt::format(form, std::forward<Args>(args)...) + "\n";
  }

  void terrain() {
    d = dice.one_of({8.0, 12.0});
    cell = d * dice.from(1, 2.5);
    length = d * dice.from(50, 70);
    half = d * dice.from(8, 13);
    const double angle = dice.from(25, 50);
    line("mode: coupled");
    if (dice.chance(0.2)) {
      const double arc = length * dice.from(0.2, 0.4), slope = length * dice.from(0.3, 0.5);
      line("terrain: {{kind: chute, angle: {:.3f} deg, slope: {:.3f} mm, arc: {:.3f} mm, runout: {:.3f} mm, width: {:.3f} mm}}",
           angle, slope, arc, length - arc - slope, 2 * half);
      length = slope + arc + (length - arc - slope);
    } else {
      line("terrain: {{kind: incline, angle: {:.3f} deg, length: {:.3f} mm, width: {:.3f} mm}}", angle, length, 2 * half);
    }
    length = std::floor(1e3 * length) / 1e3 - 1e-3, half = std::floor(1e3 * half) / 1e3 - 1e-3;  // as printed
    line(
        "material: {{density: 1400 kg/m3, internal_friction_angle: 35 deg, basal_friction_angle: 21.8014 deg, diameter: {:g} "
        "mm}}",
        d);
  }

  // All scenes of a diameter are cut from the same few packings: an inflow that may come only when the run is over sets how deep
  // they are.
  void sides() {
    const double deepest = 4 * d;
    const bool fed = dice.chance(0.25);
    const double start = fed ? dice.from(0, 30) : 1e5, u = dice.from(0.3, 1.2),
                 later = fed ? dice.from(0.2, 1) * deepest : deepest;
    std::string upstream = fmt::format(
        "{{inflow: {{kind: hydrograph, hydrograph: [[{0:.3f} ms, {1:.3f} mm, {2:.3f} m/s], [{3:.3f} ms, {4:.3f} mm, {2:.3f} "
        "m/s]]}}}}",
        start, deepest, u, start + dice.from(50, 300), later);
    periodic = dice.chance(0.15);
    const auto other = [&] { return dice.chance(0.35) ? "wall" : "outflow"; };
    const std::string left = periodic ? "periodic" : other(), right = periodic ? "periodic" : other();
    line("boundaries: {{upstream: {}, downstream: {}, left: {}, right: {}}}", upstream, other(), left, right);
  }

  void release() {
    depth = d * dice.from(1.5, 3.5);
    const double u = dice.chance(0.15) ? 0 : dice.from(0.2, 1.5), along = d * dice.from(6, 16), x = d * dice.from(0.5, 3);
    const double across = std::min(2 * half, d * dice.from(6, 20)),
                 off = dice.chance(0.5) ? 0 : dice.from(-1, 1) * (half - across / 2);
    switch (dice.whole(0, 3)) {
      case 0:
        line(
            "release: {{kind: ellipsoid, centre: [{:.3f} mm, {:.3f} mm], semi_axes: [{:.3f} mm, {:.3f} mm, {:.3f} mm], velocity: "
            "{:.3f} m/s}}",
            x + along / 2, off, along / 2, across / 2 - 1e-3, depth, u);
        break;
      case 1: {
        const double radius = std::min(along, across) / 2 - 1e-3;
        line(
            "release: {{kind: cap, centre: [{:.3f} mm, {:.3f} mm], base_radius: {:.3f} mm, height: {:.3f} mm, velocity: {:.3f} "
            "m/s}}",
            x + along / 2, off, radius, std::min(depth, radius), u);
        break;
      }
      default:
        line(
            "release: {{kind: block, position: [{:.3f} mm, {:.3f} mm], length: {:.3f} mm, width: {:.3f} mm, height: {:.3f} mm, "
            "velocity: "
            "{:.3f} m/s}}",
            x, off, along, across - 2e-3, depth, u);
    }
    release_end = x + along;
  }

  std::string cuboid(double x, double y, double wide) {
    const double thick = cell * dice.from(1, 2), tall = d * dice.from(2, 7);
    last = std::max(last, x + thick);
    low = std::min(low, y - wide / 2), high = std::max(high, y + wide / 2);
    return fmt::format("{{position: [{:.3f} mm, {:.3f} mm], size: [{:.3f} mm, {:.3f} mm, {:.3f} mm]}}", x, y, thick, wide, tall);
  }

  void obstacles() {
    const int kind = dice.whole(0, 9);
    if (kind == 0) return;  // a zone of its own
    obstacle = true;
    first = release_end + d * dice.from(7, 20);
    last = first, low = 1e9, high = -1e9;
    const double room = 2 * half - 6 * d;  // beside which a zone has space
    if (kind <= 5) {
      const bool all = walls_both() && dice.chance(0.4);  // across the whole flow
      const double wide = all ? 2 * half : std::max(cell * 1.01, room * dice.from(0.2, 0.9));
      line("obstacles: {{wall: {}}}", cuboid(first, all ? 0 : dice.from(-0.5, 0.5) * (room - wide), wide));
    } else if (kind <= 7) {  // side by side, maybe with a gap of a few grains
      const double wide = std::max(cell * 1.01, room * dice.from(0.15, 0.35)), gap = d * dice.from(1, 4);
      const std::string a = cuboid(first, -(gap + wide) / 2, wide),
                        b = cuboid(first + d * dice.from(0, 2), (gap + wide) / 2, wide);
      line("obstacles: {{low: {}, high: {}}}", a, b);
    } else {
      const double wide = std::max(2.1 * cell, room * dice.from(0.3, 0.9)),
                   long_ = std::max(2.1 * cell, wide * dice.from(0.5, 1));
      const double tall = d * dice.from(2, 7), y = dice.from(-0.5, 0.5) * (room - wide);
      line(
          "obstacles: {{wedge: {{shape: tetrahedron, position: [{:.3f} mm, {:.3f} mm], size: [{:.3f} mm, {:.3f} mm, {:.3f} mm], "
          "method: "
          "elevation}}}}",
          first, y, long_, wide, tall);
      last = first + long_, low = y - wide / 2, high = y + wide / 2;
    }
  }

  bool walls_both() const {
    return text.find("left: wall, right: wall") != std::string::npos || text.find("left: periodic") != std::string::npos;
  }

  void zone() {
    std::string box = "auto";
    if (!obstacle || dice.chance(0.65)) {
      const double x = obstacle ? first : release_end + d * dice.from(6, 15), end = obstacle ? last : x + 8 * d;
      const double a = obstacle ? low : -2 * d, b = obstacle ? high : 2 * d;
      // Room for what the cell lines may take away.
      double x0 = x - cell - d * dice.from(5.1, 25), x1 = end + cell + d * dice.from(2.1, 15),
             y0 = a - cell - d * dice.from(2.1, 10), y1 = b + cell + d * dice.from(2.1, 10);
      x0 = std::max(x0, 3.1 * d + cell), x1 = x1 > length - 3 * d ? length : x1;
      const bool whole = periodic || dice.chance(0.2);
      if (whole || y0 < -half + 3 * d) y0 = -half;
      if (whole || y1 > half - 3 * d) y1 = half;
      box = fmt::format("{{x: [{:.3f} mm, {:.3f} mm], y: [{:.3f} mm, {:.3f} mm]}}", x0, x1, y0, y1);
    }
    line(
        "grains: {{diameter: {:g} mm, zone: {}, window: {}, seed: {}, ranks: {}, timeout: 600 s, wall_friction: {:.3f}, "
        "side_friction: {:.3f}}}",
        d, box, dice.whole(8, 40), dice.one_of({20011, 20021}), dice.chance(0.04) ? 2 : 1, dice.from(0, 0.8),
        dice.chance(0.5) ? 0.0 : 0.4);
  }

  void continuum() {
    line("continuum: {{cell: {:.3f} mm{}{}}}", cell,
         dice.chance(0.3) ? fmt::format(", cell_across: {:.3f} mm", cell * dice.from(0.8, 1)) : "",
         dice.chance(0.1) ? ", adapt: {levels: 1, interval: 4}" : "");
  }
};

}  // namespace

std::string random_scene(std::uint64_t seed) {
  Draw draw(seed);
  draw.line("title: random scene {}", seed);
  draw.terrain();
  draw.sides();
  draw.release();
  draw.obstacles();
  draw.zone();
  draw.continuum();
  draw.line("record: {{frames: 0.01 ms, forces: 1 ms}}");  // a frame each window
  draw.line("duration: {:.1f} ms", draw.dice.from(150, 400));
  return draw.text;
}

}  // namespace couloir
