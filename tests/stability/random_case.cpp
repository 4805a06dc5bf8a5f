#include "random_case.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "tests/continuum/scenes.hpp"

namespace couloir::test {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  // The standard's distributions differ between libraries.
  double unit() { return double(engine_() >> 11) * 0x1p-53; }
  double from(double a, double b) { return a + (b - a) * unit(); }
  double log_from(double a, double b) { return a * std::pow(b / a, unit()); }
  int whole(int a, int b) { return a + int(unit() * (b - a + 1)); }
  bool chance(double p) { return unit() < p; }

 private:
  std::mt19937_64 engine_;
};

// 20 significant bits, so that the centres of mirrored rows are mirrored to the bit.
double short_number(double v) {
  int exponent = 0;
  const double m = std::frexp(v, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(m, 20)), exponent - 20);
}

struct Draw {
  Dice dice;
  RandomCase out;
  Case& c = out.scene;
  double length = 0, width = 0, depth = 0;
  std::ostringstream words;

  explicit Draw(std::uint64_t seed) : dice(seed) {}

  void grid() {
    const int nx = dice.whole(4, 24), ny = dice.chance(0.2) ? 1 : dice.whole(2, 18);
    const double unit = dice.chance(0.2) ? dice.log_from(1e-6, 1e6) : 1.0;
    const double dx = short_number(unit * dice.log_from(0.01, 1));
    const double dy = short_number(dx * (dice.chance(0.3) ? dice.log_from(0.05, 20) : 1.0));
    const double angle = dice.chance(0.15) ? 0 : dice.chance(0.2) ? dice.from(60, 89) : dice.from(0, 60);
    c = plane(degrees(angle), nx, ny, dx, dy);
    length = nx * dx, width = ny * dy;
    depth = length * dice.log_from(0.002, 0.5);
    if (dice.chance(0.25)) {
      c.arc = length * dice.from(0.1, 0.5);
      c.slope = length * dice.from(0.1, 0.4);
      c.runout = std::max(0.0, length - c.arc - c.slope);
    }
    c.settings.dry_depth = depth * dice.log_from(1e-9, 1e-4);
    c.settings.cfl = dice.chance(0.5) ? 0.5 : dice.from(0.05, 0.5);
    c.settings.block = dice.whole(4, 32);
    c.settings.limiter = Limiter(dice.whole(0, 3));
    words << nx << " x " << ny << " cells, " << angle << " deg, depth / cell " << depth / dx << ", cfl " << c.settings.cfl
          << ", limiter " << int(c.settings.limiter) << (c.arc > 0 ? ", arc" : "");
  }

  void closure() {
    const double phi = dice.chance(0.2) ? dice.from(60, 88) : dice.from(15, 50);
    const double delta = dice.chance(0.2) ? phi : dice.chance(0.2) ? phi * (1 - dice.log_from(1e-12, 1e-2)) : dice.from(0, phi);
    Closure& k = c.settings.closure;
    const bool active_passive = dice.chance(0.6);
    if (active_passive) k.earth_pressure = EarthPressure::active_passive(degrees(phi), degrees(delta));
    const bool friction = active_passive || dice.chance(0.6);
    k.tan_delta = friction ? std::tan(degrees(delta)) : 0;
    words << (active_passive ? ", phi " : ", K = 1, phi ") << phi << ", delta " << (friction ? delta : 0);
  }

  Side side() {
    Side s;
    const double u = dice.unit();
    s.kind = u < 0.45 ? Side::Kind::wall : u < 0.8 ? Side::Kind::outflow : Side::Kind::inflow;
    if (s.kind == Side::Kind::inflow) {
      s.depth = dice.chance(0.1) ? 0 : depth * dice.from(0.01, 1);
      s.velocity = std::sqrt(9.81 * depth) * dice.from(0, 4);
    }
    return s;
  }

  void sides() {
    for (int low : {0, 2}) {
      for (int k : {0, 1}) c.settings.sides[low + k] = side();
      const bool periodic = dice.chance(0.2) && !(low == 0 && c.arc > 0);
      if (periodic) c.settings.sides[low].kind = c.settings.sides[low + 1].kind = Side::Kind::periodic;
    }
    const char* names[] = {"wall", "outflow", "periodic", "inflow"};
    words << ", sides";
    for (const Side& s : c.settings.sides) words << " " << names[int(s.kind)];
  }

  void bed() {
    const Grid& g = c.grid();
    const int obstacles = dice.chance(0.5) ? 0 : dice.whole(1, 3);
    for (int n = 0; n < obstacles; ++n) {
      // Edges on grid lines, on cell centres, or anywhere.
      const int way = dice.whole(0, 2);
      const auto edge = [&](double low, double cells, double step) {
        const double at = dice.from(0, cells);
        return low + step * (way == 0 ? std::floor(at) : way == 1 ? std::floor(at) + 0.5 : at);
      };
      const double x0 = edge(0, g.nx - 1, g.dx), y0 = edge(g.y0, g.ny - 1, g.dy);
      const double wide = dice.chance(0.3) ? 1 : dice.whole(1, 4);
      c.bed.obstacles.push_back({"block", x0, x0 + g.dx * (dice.chance(0.3) ? 1 : dice.whole(1, 4)), y0, y0 + g.dy * wide,
                                 depth * (dice.chance(0.3) ? 100 : dice.log_from(0.01, 10))});
    }
    const bool relief = dice.chance(0.25);
    if (relief) {
      const double steep = dice.log_from(0.01, 24), ax = dice.from(0, 6), ay = dice.from(0, 6);
      const bool rough = dice.chance(0.5);
      for (int j = 0; j < g.ny; ++j) {
        for (int i = 0; i < g.nx; ++i) {
          c.bed.elevation.push_back(steep * g.dx * (rough ? dice.unit() : std::sin(ax * i) * std::cos(ay * j)));
        }
      }
      words << (rough ? ", rough bed " : ", wavy bed ") << steep;
    }
    words << ", " << obstacles << " obstacles";
  }

  void release() {
    const Grid& g = c.grid();
    const int kind = dice.whole(0, 5);
    const double speed = std::sqrt(9.81 * depth) * (dice.chance(0.4) ? 0 : dice.log_from(0.1, 10));
    const double way = dice.from(0, 2 * pi), u = speed * std::cos(way), v = g.ny > 1 ? speed * std::sin(way) : 0;
    const double cx = dice.from(0, length), cy = g.y0 + dice.from(0, width), rx = length * dice.from(0.05, 0.5);
    const double ry = g.ny > 1 ? width * dice.from(0.05, 0.5) : 1e300;
    const double film = depth * dice.log_from(1e-12, 1e-2);
    c.fill([&](double x, double y) -> FlowState {
      const double r2 = (x - cx) * (x - cx) / (rx * rx) + (y - cy) * (y - cy) / (ry * ry);
      double h = 0, sx = 1, sy = 1;
      switch (kind) {
        case 0:  // a heap on a dry bed
          h = std::max(0.0, depth * (1 - r2));
          break;
        case 1:  // a block on a film
          h = r2 < 1 ? depth : film;
          break;
        case 2:  // two flows apart or together
          h = depth, sx = sy = x < cx ? -1 : 1;
          break;
        case 3:  // uniform
          h = depth;
          break;
        case 4:  // anything in each cell, and some cells dry
          h = dice.chance(0.3) ? 0 : depth * dice.log_from(1e-14, 1);
          sx = dice.from(-1, 1), sy = dice.from(-1, 1);
          break;
        default:  // films
          h = film * dice.unit();
      }
      return {h, sx * h * u, sy * h * v};
    });
    const char* names[] = {"heap", "block on film", "two flows", "uniform", "noise", "films"};
    words << ", " << names[kind] << ", Froude " << speed / std::sqrt(9.81 * depth);
  }
};

}  // namespace

RandomCase random_case(std::uint64_t seed) {
  Draw draw(seed);
  draw.grid();
  draw.closure();
  draw.sides();
  draw.bed();
  draw.release();
  draw.out.steps = draw.dice.whole(24, 120);
  draw.out.words = draw.words.str();
  return std::move(draw.out);
}

}  // namespace couloir::test
