// A run that was interrupted and gone on with, twice, is the unbroken one: every figure, every file, to the bit.

#include "recorded_run.hpp"

namespace couloir {
namespace {

struct Kind {
  const char* name;
  const char* mode;
  Overrides more;
  int threads = 1;
  const char* scene = "small_wall";
  const char* happens = "";  // an event that the run must have
};

const Overrides with_gauges{
    {"record.gauges", "{before: {position: [350 mm, 0]}, beside: {position: [390 mm, 60 mm], size: [20 mm, 20 mm]}}"}};

Overrides and_gauges(Overrides more) {
  more.insert(more.end(), with_gauges.begin(), with_gauges.end());
  return more;
}

class SameBits : public testing::TestWithParam<Kind> {};

TEST_P(SameBits, AsTheUnbrokenRun) {
  const Kind& kind = GetParam();
  Overrides set = kind.more;
  set.insert(set.begin(), {"mode", kind.mode});
  const Scene scene = read_scene(fmt::format("{}/tests/scenes/{}.yaml", COULOIR_SOURCE_DIR, kind.scene),
                                 COULOIR_SOURCE_DIR "/dem_inputs/materials", set);
  RecordedRun whole(fmt::format("{}_whole", kind.name), scene), broken(fmt::format("{}_broken", kind.name), scene);
  whole.options.threads = broken.options.threads = kind.threads;
  ASSERT_EQ(whole.go(false).status, "done");
  EXPECT_FALSE(std::filesystem::exists(whole.options.checkpoints)) << "what is done needs none";
  const long windows = long(RecordsReader(whole.folder + "/records.h5").window("time").size());
  ASSERT_EQ(broken.go(false, windows / 3).status, "interrupted");
  const RunEnd second = broken.go(true, windows / 2);
  ASSERT_EQ(second.status, "interrupted");
  EXPECT_GT(second.checkpoint, 0.5 * scene.duration);
  ASSERT_EQ(broken.go(true).status, "done");
  expect_same(whole, broken);
  EXPECT_NE(broken.figures().at("events").dump().find(kind.happens), std::string::npos);
}

const Overrides quick_grains{{"duration", "0.14 s"}, {"record.frames", "20 ms"}, {"record.checkpoint", "9 ms"}};

Overrides quick(Overrides more = {}) {
  more.insert(more.begin(), quick_grains.begin(), quick_grains.end());
  return more;
}

const char* over_elevation = "{wall: {shape: cuboid, position: [400 mm, 0], size: [10 mm, 60 mm, 40 mm], method: elevation}}";
const char* of_planes = "{wall: {shape: cuboid, position: [400 mm, 0], size: [40 mm, 60 mm, 40 mm], method: planes}}";

INSTANTIATE_TEST_SUITE_P(
    Of, SameBits,
    testing::Values(
        Kind{"upwind", "continuum", and_gauges({{"record.forces", "2.5 ms"}})},
        Kind{"sides", "continuum",
             and_gauges({{"boundaries.left", "wall"}, {"boundaries.upstream", "{inflow: {depth: 10 mm, velocity: 1 m/s}}"}})},
        Kind{"two_threads", "continuum", {{"continuum.cell", "5 mm"}}, 2},
        Kind{"noc", "continuum", {{"continuum.scheme", "noc"}, {"obstacles", over_elevation}}},
        Kind{"noc_refined",
             "continuum",
             {{"continuum.scheme", "noc"},
              {"obstacles", over_elevation},
              {"continuum.refine", "[{around: wall, up: 60 mm, left: 30 mm, right: 30 mm}]"}}},
        Kind{"planes", "continuum", {{"obstacles", of_planes}}},
        Kind{"refined", "continuum", {{"continuum.refine", "[{around: wall, up: 60 mm, left: 30 mm, right: 30 mm, levels: 2}]"}}},
        Kind{"adaptive", "continuum", and_gauges({{"continuum.adapt", "{levels: 2, interval: 4}"}, {"continuum.block", "8"}})},
        Kind{"coupled", "coupled", and_gauges(quick())}, Kind{"coupled_two_ranks", "coupled", quick({{"grains.ranks", "2"}})},
        Kind{"coupled_adaptive_two_ranks", "coupled",
             quick({{"grains.ranks", "2"}, {"continuum.adapt", "{levels: 1, interval: 4}"}, {"duration", "0.1 s"}})},
        Kind{"coupled_control", "coupled",
             quick({{"grains.rotation", "{control: {retarding_time: 5 ms}}"}, {"duration", "0.1 s"}})},
        Kind{"coupled_to_the_edge", "coupled",
             quick({{"grains.zone", "{x: [270 mm, 600 mm], y: [-100 mm, 100 mm]}"}, {"duration", "0.22 s"}})},
        Kind{"coupled_grows", "coupled", quick({{"grains.diameter", "7 mm"}, {"duration", "0.3 s"}}), 1, "channel_wall",
             "zone grows"},
        Kind{"coupled_airborne", "coupled",
             quick({{"release",
                     "{kind: block, position: [100 mm, 0], length: 100 mm, width: 60 mm, height: 20 mm, velocity: 2.5 m/s}"},
                    {"obstacles.wall.size", "[10 mm, 100 mm, 15 mm]"},
                    {"duration", "0.2 s"}})},
        Kind{"coupled_oblique", "coupled", quick({{"release.velocity_across", "0.5 m/s"}, {"duration", "0.16 s"}})},
        Kind{"coupled_yade", "coupled", quick({{"grains.engine", "yade"}, {"duration", "0.1 s"}})},
        Kind{"grains", "grains", quick({{"duration", "50 ms"}, {"record.checkpoint", "2 ms"}})},
        Kind{"grains_fed", "grains",
             quick({{"release", "{kind: none}"},
                    {"boundaries.upstream", "{inflow: {depth: 20 mm, velocity: 1.5 m/s}}"},
                    {"duration", "0.1 s"}})},
        Kind{"grains_two_ranks", "grains", quick({{"grains.ranks", "2"}, {"duration", "50 ms"}, {"record.checkpoint", "2 ms"}})},
        Kind{"grains_yade", "grains", quick({{"grains.engine", "yade"}, {"duration", "8 ms"}, {"record.checkpoint", "0.5 ms"}})}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace couloir
