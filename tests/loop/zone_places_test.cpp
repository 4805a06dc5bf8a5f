// A zone of grains anywhere: on the incline, across the arc, on the run-out; with several obstacles; open on all sides.

#include <cmath>
#include <numbers>

#include "small_run.hpp"

namespace couloir {
namespace {

struct Kept {
  double mass = 0, residual = 0;  // largest of all windows, relative
};

Kept kept(const Watched& run) {
  Kept out;
  for (const WindowReport& w : run.windows) {
    out.mass = std::max(out.mass, w.mass.relative_error());
    if (w.momentum.scale > 0) out.residual = std::max(out.residual, std::abs(w.momentum.residual) / w.momentum.scale);
  }
  return out;
}

// Incline to 0.3 m, arc to 0.5 m, run-out to 1.2 m.
Overrides on_chute(const std::string& release_x, const std::string& zone, const std::string& obstacles) {
  return {{"terrain", "{kind: chute, angle: 35 deg, slope: 300 mm, arc: 200 mm, runout: 700 mm, width: 200 mm}"},
          {"release",
           "{kind: block, position: [" + release_x + ", 0], length: 120 mm, width: 100 mm, height: 30 mm, velocity: 1.5 m/s}"},
          {"grains.zone", zone},
          {"obstacles", obstacles},
          {"duration", "0.2 s"}};
}

// Every window's ledgers, and that something has happened on each obstacle.
void holds(const std::string& name, const Overrides& set) {
  const Scene scene = small_scene("coupled", set);
  const Watched run = watch(scene, options_in(fresh_folder(name)));
  ASSERT_EQ(run.end.status, "done") << name;
  const Kept k = kept(run);
  std::printf("%s: mass %.1e, momentum %.4f, %ld grains in, %ld back\n", name.c_str(), k.mass, k.residual,
              run.windows.back().inserted, run.windows.back().returned);
  EXPECT_LE(k.mass, 1e-12) << name;
  EXPECT_LT(k.residual, 0.03) << name;
  EXPECT_GT(run.windows.back().inserted, 300) << name;
  for (const WindowReport& w : run.windows) {
    ASSERT_LT(w.max_overlap, 0.15) << name << " at " << w.time;
    ASSERT_LT(w.max_speed, 6) << name << " at " << w.time;  // nothing is thrown out: it comes with 1.5 m/s and falls 0.2 m
  }
  for (const auto& frame : run.frames)
    for (const double x : frame) ASSERT_TRUE(std::isfinite(x)) << name;
  for (std::size_t o = 0; o < scene.obstacles.size(); ++o) {
    double impulse = 0;
    for (const WindowReport& w : run.windows) impulse += w.obstacles[o].force[0] * w.length;
    EXPECT_GT(impulse, 0.005) << name << " " << scene.obstacles[o].name;
  }
}

TEST(ZonePlaces, OnTheIncline) {
  holds("incline", on_chute("0 mm", "{x: [150 mm, 290 mm], y: [-70 mm, 70 mm]}",
                            "{wall: {position: [250 mm, 0], size: [10 mm, 60 mm, 40 mm]}}"));
}

TEST(ZonePlaces, AcrossTheArc) {
  holds("arc", on_chute("130 mm", "{x: [270 mm, 560 mm], y: [-70 mm, 70 mm]}",
                        "{wall: {position: [450 mm, 0], size: [10 mm, 60 mm, 40 mm]}}"));
}

TEST(ZonePlaces, OnTheRunout) {
  holds("runout", on_chute("510 mm", "{x: [660 mm, 840 mm], y: [-70 mm, 70 mm]}",
                           "{wall: {position: [760 mm, 0], size: [10 mm, 60 mm, 40 mm]}}"));
}

// Grains are laid on the arc itself: chords of the bed would hold them there, and the flow would dam up before the face.
TEST(ZonePlaces, AFaceOnTheArcLetsTheFlowIn) {
  const auto impulse = [](const std::string& from) {
    Overrides set = on_chute("60 mm", "{x: [" + from + ", 600 mm], y: [-100 mm, 100 mm]}",
                             "{wall: {position: [510 mm, 0], size: [10 mm, 80 mm, 40 mm]}}");
    set.push_back({"boundaries", "{left: wall, right: wall}"});
    set.push_back({"grains.follow", "off"});
    set.push_back({"duration", "0.3 s"});
    double sum = 0;
    const Watched run = watch(small_scene("coupled", set), options_in(fresh_folder("face_on_arc")));
    for (const WindowReport& w : run.windows) sum += w.obstacles[0].force[0] * w.length;
    return sum;
  };
  const double before = impulse("280 mm"), on = impulse("380 mm");
  std::printf("impulse on the wall: %.4f N s with a face before the arc, %.4f N s with one on it\n", before, on);
  EXPECT_NEAR(on / before, 1, 0.2);
}

// Over a brink, down an arc and onto a gentler slope: all within one zone, as wide as the domain.
TEST(ZonePlaces, AcrossAProfile) {
  Overrides set = on_chute("60 mm", "{x: [200 mm, 760 mm], y: [-100 mm, 100 mm]}",
                           "{wall: {position: [640 mm, 0], size: [10 mm, 60 mm, 40 mm]}}");
  set[0] = {
      "terrain",
      "{kind: profile, width: 200 mm, profile: [[0, 25 deg], [250 mm, 25 deg], [350 mm, 35 deg], [420 mm, 35 deg], [560 mm, "
      "10 deg], [1 m, 0 deg]]}"};
  set.push_back({"boundaries", "{left: wall, right: wall}"});
  set.push_back({"duration", "0.4 s"});
  holds("profile", set);
}

TEST(ZonePlaces, WithSeveralObstacles) {
  holds(
      "several",
      on_chute("0 mm", "{x: [150 mm, 330 mm], y: [-90 mm, 90 mm]}",
               "{left: {position: [240 mm, -25 mm], size: [10 mm, 30 mm, 40 mm]}, right: {position: [240 mm, 25 mm], "
               "size: [10 mm, 30 mm, 40 mm]}, wedge: {shape: tetrahedron, position: [265 mm, 0], size: [40 mm, 40 mm, 30 mm]}}"));
}

TEST(ZonePlaces, FlowAlongItsSidesAcrossTheArcStaysAsItIs) {
  const Scene scene =
      read_scene(COULOIR_SOURCE_DIR "/tests/scenes/along_the_arc.yaml", COULOIR_SOURCE_DIR "/dem_inputs/materials",
                 {{"grains.diameter", "8 mm"}, {"duration", "0.22 s"}});
  const Watched run = watch(scene, options_in(fresh_folder("along_the_arc")));
  EXPECT_LE(kept(run).mass, 1e-12);
  const auto depth = [&](double y0, double y1) {  // [m] on the arc where y0 < |y| < y1, the last frames' mean
    double sum = 0;
    int n = 0;
    for (std::size_t f = run.frames.size() - 5; f < run.frames.size(); ++f)
      for (int j = 0; j < 24; ++j)
        for (int i = 43; i < 57; ++i)
          if (const double y = std::abs(0.01 * j - 0.115); y > y0 && y < y1) sum += run.frames[f][std::size_t(100 * j + i)], ++n;
    return sum / n;
  };
  const double all = depth(0, 1);
  std::printf("on the arc: %.4f m; in the zone %.4f, along its sides %.4f inside, %.4f outside\n", all, depth(0, 0.06),
              depth(0.04, 0.06), depth(0.06, 0.08));
  EXPECT_NEAR(depth(0, 0.06), all, 0.06 * all);
  EXPECT_NEAR(depth(0.04, 0.06), all, 0.12 * all) << "spread through its sides";
  EXPECT_NEAR(depth(0.06, 0.08), all, 0.1 * all) << "dammed up beside it";
}

// What flows in the zone across the arc with nothing in it is what grains do there without a zone.
TEST(ZonePlaces, AnEmptyZoneAcrossTheArcIsAsGrainsAre) {
  Overrides set{{"terrain", "{kind: chute, angle: 35 deg, slope: 400 mm, arc: 200 mm, runout: 400 mm, width: 60 mm}"},
                {"release", "{kind: block, position: [0 mm, 0], length: 250 mm, width: 60 mm, height: 30 mm, velocity: 1.5 m/s}"},
                {"boundaries", "{left: periodic, right: periodic}"},
                {"obstacles", "{}"},
                {"continuum.closure", "hydraulic"},
                {"grains.zone", "{x: [300 mm, 700 mm], y: [-30 mm, 30 mm]}"},
                {"record.frames", "20 ms"},
                {"duration", "0.24 s"}};
  struct Slab {
    double mass = 0, speed = 0;
  };
  // Of the grains between the zone's middle third, the last frames' mean.
  const auto in_the_arc = [](const Scene& scene, const Watched& run, double x0, double x1) {
    const ReferenceSurface surface = ReferenceSurface::chute(scene.terrain.angle, 0.4, 0.2, 0.4);
    Slab sum;
    for (std::size_t f = run.frames.size() - 4; f < run.frames.size(); ++f) {
      const auto& all = run.frames[f];
      const std::size_t cells = scene.mode == Mode::coupled ? 3 * std::size_t(100 * 6) : 0, n = (all.size() - cells) / 6;
      for (std::size_t k = 0; k < n; ++k) {
        const auto at = [&](int c) { return all[cells + c * n + k]; };
        const SurfacePoint p = surface.to_surface({at(0), at(1), at(2)});
        if (p.x < x0 || p.x > x1) continue;
        sum.mass += 1, sum.speed += Eigen::Vector3d(at(3), at(4), at(5)).dot(surface.tangent(p.x));
      }
    }
    sum.speed /= sum.mass;
    return sum;
  };
  const Scene with_zone = small_scene("coupled", set), without = small_scene("grains", set);
  const Watched coupled = watch(with_zone, options_in(fresh_folder("arc_coupled")));
  const Watched grains = watch(without, options_in(fresh_folder("arc_grains")));
  EXPECT_LE(kept(coupled).mass, 1e-12);
  const Slab a = in_the_arc(with_zone, coupled, 0.43, 0.57), b = in_the_arc(without, grains, 0.43, 0.57);
  std::printf("on the arc: %.4g and %.4g grains, %.4f and %.4f m/s\n", a.mass, b.mass, a.speed, b.speed);
  EXPECT_NEAR(a.mass / b.mass, 1, 0.1);
  EXPECT_NEAR(a.speed / b.speed, 1, 0.05);
}

}  // namespace
}  // namespace couloir
