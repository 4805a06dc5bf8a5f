#include "coupling/scene/check_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/scene/names.hpp"
#include "coupling/scene/refine.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

struct Checker {
  const Scene& scene;
  const ContinuumSpec& c = scene.continuum;
  double length = scene.terrain.total_length(), half = scene.terrain.width / 2;
  double room = 1e-9 * (length + half);

  template <class... Args>
  [[noreturn]] void fail(const std::string& key, fmt::format_string<Args...> text, Args&&... args) const {
    throw SceneError(fmt::format("{}: {} {}", scene.places.of(key), key, fmt::format(text, std::forward<Args>(args)...)));
  }

  void mesh() const {
    if (scene.mode == Mode::grains) return;
    const double cell = c.cell, width = 2 * half;
    if (cell == 0) {
      fail("continuum.cell", "is missing: mode {} needs the edge of a cell, a length such as 5 mm", to_string(scene.mode));
    }
    const double across = c.across();
    if (cell > length / 4 || across > width) {
      fail("continuum.cell", "is {}, too large for a domain of {} by {}: it needs 4 cells along the slope and 1 across",
           len(cell), len(length), len(width));
    }
    if (scene.release.velocity_across != 0 && across > 0.75 * width)
      fail("release.velocity_across",
           "is {:.3g} m/s in a domain of one row of cells, which flows along the slope only; leave it out, or use smaller cells",
           scene.release.velocity_across);
    const double cells = length / cell * width / across;
    if (cells > most_cells) {
      fail("continuum.cell", "is {}, which makes {:.3g} million cells, more than the {:.3g} million allowed; use at least {}",
           len(cell), cells * 1e-6, most_cells * 1e-6, len(std::sqrt(length * width / most_cells)));
    }
  }

  static std::string entry(std::size_t n) { return fmt::format("continuum.refine[{}]", n); }

  void place(const RefineSpec& r, const std::string& key) const {
    const bool given = r.x0 != 0 || r.x1 != 0 || r.y0 != 0 || r.y1 != 0;
    if (r.around.empty() && !given) {
      fail(key, "has no place; give around: <obstacle>, or x: [from, to] and y: [from, to]");
    }
    if (!r.around.empty() && given) fail(key, "has both an obstacle (around: {}) and x or y; give one of them", r.around);
    const bool reaches = r.up != 0 || r.down != 0 || r.left != 0 || r.right != 0 || r.from != RefineSpec::From::base;
    if (r.around.empty() && reaches)
      fail(key, "has up, down, left, right or from, which belong to around: <obstacle>; leave them out");
    if (!r.around.empty()) around(r, key);
  }

  void around(const RefineSpec& r, const std::string& key) const {
    std::vector<std::string> names;
    for (const ObstacleSpec& o : scene.obstacles) names.push_back(o.name);
    if (std::ranges::count(names, r.around) > 0) return;
    if (names.empty()) fail(key + ".around", "is '{}', but the scene has no obstacles; give x and y instead", r.around);
    fail(key + ".around", "is '{}', but no obstacle has that name{}", r.around, suggestion(r.around, names, "there is"));
  }

  void box(const RefineSpec& r, const std::string& key) const {
    const RefineRectangle b = refine_rectangle(scene, r);
    if (b.empty()) {
      const char* remedy = r.around.empty() ? "give [from, to] with from below to" : "give up or down a length";
      fail(key, "is empty: x from {} to {}, y from {} to {}; {}", len(b.x0), len(b.x1), len(b.y0), len(b.y1), remedy);
    }
    const bool out = b.x0 < -room || b.x1 > length + room || b.y0 < -half - room || b.y1 > half + room;
    if (within_domain(scene, b).empty() || (r.around.empty() && out)) {
      fail(key,
           "covers x from {} to {} and y from {} to {}, which reaches out of the domain (x from 0 to {}, y from {} to {}); {}",
           len(b.x0), len(b.x1), len(b.y0), len(b.y1), len(length), len(-half), len(half),
           r.around.empty() ? "give x and y within it" : "give up, down, left and right within it");
    }
  }

  int levels() const {
    int most = c.adapt.levels;
    for (const RefineSpec& r : c.refine) most = std::max(most, r.levels);
    return most;
  }

  // Refined cells need a solver that has them.
  void solver() const {
    const bool noc = c.scheme == "noc";
    if (noc && c.adapt.levels > 0) {
      fail("continuum.adapt",
           "belongs to scheme central_upwind: noc refines rectangles only; use continuum.refine, or another scheme");
    }
    if (noc && c.block > 0) fail("continuum.block", "belongs to scheme central_upwind: noc has no blocks; leave it out");
    if (scene.mode != Mode::continuum || !c.refined()) return;
    for (const ObstacleSpec& o : scene.obstacles) {
      if (o.method != ObstacleSpec::Method::planes) continue;
      fail(c.refine.empty() ? "continuum.adapt" : "continuum.refine",
           "is not offered together with obstacles of method planes; give obstacles.{} another method, or leave the cells as "
           "they are",
           o.name);
    }
  }

  void block() const {
    if (c.block == 0 || c.scheme == "noc") return;
    const int whole = std::max(2, 1 << levels());
    if (c.block % whole != 0 || c.block < 4) {
      fail("continuum.block", "is {}; with {} level{} of refinement it must be a multiple of {}", c.block, levels(),
           levels() == 1 ? "" : "s", std::max(4, whole));
    }
  }

  void cells() const {
    const double cells = estimated_cells(scene);
    if (cells <= most_cells) return;
    std::string key = "continuum.adapt.levels";
    for (std::size_t n = 0; n < c.refine.size(); ++n) {
      if (c.refine[n].levels == levels()) key = entry(n) + ".levels";
    }
    fail(key,
         "is {}, which would make about {:.3g} million cells, more than the {:.3g} million allowed; use fewer levels or larger "
         "cells",
         levels(), cells * 1e-6, most_cells * 1e-6);
  }
};

}  // namespace

void check_mesh(const Scene& scene) {
  Checker{scene}.mesh();
}

void check_refinement(const Scene& scene) {
  const Checker check{scene};
  for (std::size_t n = 0; n < scene.continuum.refine.size(); ++n) {
    check.place(scene.continuum.refine[n], check.entry(n));
    check.box(scene.continuum.refine[n], check.entry(n));
  }
  if (scene.mode == Mode::grains) return;  // no cells: the plan says that these keys have no say
  check.solver();
  if (!scene.continuum.refined()) return;
  check.block();
  check.cells();
}

}  // namespace couloir
