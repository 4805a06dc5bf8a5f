// The numbers people quote: summary.json, forces.csv, the force figures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "coupling/records/console.hpp"
#include "coupling/records/force_series.hpp"
#include "coupling/records/forces_csv.hpp"
#include "coupling/records/records.hpp"
#include "coupling/records/summary.hpp"
#include "coupling/records/text_file.hpp"
#include "synthetic_run.hpp"

namespace couloir::testing {
namespace {

using ::testing::HasSubstr;

// 10 N for 5 ms alone: the 15 ms mean is a third of it; the last 50 ms hold it too.
TEST(ForceSeries, PeakIsTheMeanOver15ms) {
  ForceSeries series;
  for (int k = 1; k <= 100; ++k) series.add(k * 1e-3, 1e-3, k > 60 && k <= 65 ? 10 : 0, k > 60);
  const ForceFigures f = series.figures();
  EXPECT_NEAR(f.peak, 10.0 / 3, 1e-12);
  EXPECT_NEAR(f.peak_time, 0.065, 1e-12);
  EXPECT_EQ(f.peak_window, 10);
  EXPECT_NEAR(f.impulse, 0.05, 1e-15);
  EXPECT_NEAR(f.first_contact, 0.06, 1e-12);
  EXPECT_NEAR(f.mean, 0.05 / 0.04, 1e-12);
  EXPECT_NEAR(f.final, 0.05 / 0.05, 1e-12);
}

TEST(ForceSeries, AContactShorterThan15msIsAveragedOverItsOwnLength) {
  ForceSeries series;
  for (int k = 1; k <= 100; ++k) series.add(k * 1e-3, 1e-3, k > 96 ? 7 : 0, k > 96);
  const ForceFigures f = series.figures();
  EXPECT_NEAR(f.peak, 7, 1e-12);
  EXPECT_NEAR(f.mean, 7, 1e-12);
}

TEST(ForceSeries, PeakDoesNotHangOnTheWindows) {
  ForceSeries fine, coarse;  // a rectangle of 20 ms and 5 N, cut differently
  for (int k = 1; k <= 400; ++k) fine.add(k * 0.25e-3, 0.25e-3, k > 160 && k <= 240 ? 5 : 0, k > 160);
  for (int k = 1; k <= 10; ++k) coarse.add(k * 10e-3, 10e-3, k > 4 && k <= 6 ? 5 : 0, k > 4);
  EXPECT_NEAR(fine.figures().peak, 5, 1e-12);
  EXPECT_NEAR(coarse.figures().peak, 5, 1e-12);
  EXPECT_NEAR(coarse.figures().final, fine.figures().final, 1e-12);
}

TEST(ForceSeries, ATraceBeforeTheFrontIsNoContact) {
  ForceSeries series;
  for (int k = 1; k <= 100; ++k) series.add(k * 1e-3, 1e-3, k > 40 ? 8 : k > 10 ? 1e-6 : 0, k > 10);
  EXPECT_NEAR(series.figures().first_contact, 0.04, 1e-12);
  EXPECT_NEAR(series.figures().mean, 8, 1e-12);
}

TEST(ForceSeries, WithoutContactIsAllZeros) {
  ForceSeries series;
  EXPECT_EQ(series.figures().peak, 0);
  series.add(1e-3, 1e-3, 0, false);
  EXPECT_EQ(series.figures().mean, 0);
  EXPECT_EQ(series.figures().first_contact, -1);
}

TEST(Summary, CountsTheCellsOfARefinedMeshBySize) {
  const TemporaryFolder folder;
  SyntheticRun run(Mode::continuum);
  run.refined = true;
  record(run, folder / "a");
  const auto json = nlohmann::json::parse(read_text(folder / "a/summary.json"))["continuum"];
  EXPECT_EQ(json["cells"], 7500 + 1200 + 1600);
  ASSERT_EQ(json["levels"].size(), 3u);
  EXPECT_EQ(json["levels"][2]["level"], 2);
  EXPECT_EQ(json["levels"][2]["cell"], 0.0025);
  EXPECT_EQ(json["levels"][2]["blocks"], 1);
  EXPECT_EQ(json["levels"][2]["cells"], 1600);
}

TEST(Summary, HoldsTheKeysOfTheContract) {
  const TemporaryFolder folder;
  const SyntheticRun run(Mode::coupled);
  record(run, folder / "a");
  const auto json = nlohmann::json::parse(read_text(folder / "a/summary.json"));
  for (const char* key : {"/status",
                          "/scene",
                          "/mode",
                          "/time/simulated",
                          "/time/wall",
                          "/time/cpu",
                          "/mass/initial",
                          "/mass/final",
                          "/mass/left_domain",
                          "/mass/relative_error",
                          "/momentum/relative_residual",
                          "/continuum/cells",
                          "/continuum/levels",
                          "/continuum/steps",
                          "/continuum/cell_updates",
                          "/continuum/cell_updates_per_second",
                          "/continuum/min_depth",
                          "/continuum/refinement_drift",
                          "/grains/inserted",
                          "/grains/returned",
                          "/grains/peak_count",
                          "/grains/steps",
                          "/grains/particle_steps_per_second",
                          "/obstacles/wall/force_peak",
                          "/obstacles/wall/force_mean",
                          "/obstacles/wall/force_final",
                          "/obstacles/wall/impulse",
                          "/obstacles/wall/max_depth_on_top",
                          "/obstacles/wall/control_volume/maximum",
                          "/obstacles/wall/control_volume/mean",
                          "/obstacles/wall/control_volume/impulse",
                          "/walls/left/maximum",
                          "/effects/0/name",
                          "/effects/0/on",
                          "/effects/0/reason",
                          "/events/0/what"})
    EXPECT_TRUE(json.contains(nlohmann::json::json_pointer(key))) << key;
  EXPECT_EQ(json["status"], "done");
  EXPECT_EQ(json["mode"], "coupled");
  EXPECT_EQ(json["engine"], "LIGGGHTS 3.8.0");
  EXPECT_NEAR(json["time"]["simulated"], 0.4, 1e-12);
  EXPECT_NEAR(json["time"]["share_engine"], 0.7, 1e-12);
  EXPECT_NEAR(json["mass"]["final"], 1.2, 1e-9);
  EXPECT_NEAR(json["mass"]["left_domain"], 0.2, 1e-12);
  EXPECT_LT(json["mass"]["relative_error"], 1e-14);
  EXPECT_NEAR(json["mass"]["overtopped"], 0.05, 1e-12);
  EXPECT_EQ(json["continuum"]["cells"], 7500);
  EXPECT_TRUE(json["continuum"]["levels"].empty());
  EXPECT_EQ(json["continuum"]["cell_updates_per_second"], 15000 * 400 / 5.0);
  EXPECT_EQ(json["grains"]["peak_count"], 10000);
  EXPECT_EQ(json["grains"]["particle_steps_per_second"], 2e6);
  EXPECT_NEAR(json["grains"]["max_overlap"], 0.03, 1e-15);
  const auto& wall = json["obstacles"]["wall"];
  double impulse = 0, raw = 0;
  for (long k = 0; k < SyntheticRun::windows; ++k) {
    impulse += run.window(k).obstacles[0].force[0] * 1e-3;
    raw = std::max(raw, run.window(k).obstacles[0].force[0]);
  }
  EXPECT_NEAR(wall["impulse"], impulse, 1e-12);
  EXPECT_EQ(wall["force_peak_window"], raw);
  // 6 N and the bump's mean over the 15 ms about its top, (2/pi)(40)(20/15) sin(pi/2 15/20) N; the rattle is 4/15 N at most.
  const double bump = 40 * (2 * 20 / (std::numbers::pi * 15)) * std::sin(std::numbers::pi / 2 * 15 / 20);
  EXPECT_NEAR(wall["force_peak"], 6 + bump, 0.5);
  EXPECT_NEAR(wall["force_final"], 6, 0.1);
  EXPECT_NEAR(wall["first_contact"], 0.1, 1e-9);
  EXPECT_NEAR(wall["max_depth_on_top"], 0.004, 1e-15);
  // The other measures: maximum, mean over the whole run, impulse; a wall's are out of the domain.
  const auto& around = wall["control_volume"];
  EXPECT_EQ(around["maximum"], 1.5 * raw);
  EXPECT_NEAR(around["peak"], 1.5 * wall["force_peak"].get<double>(), 1e-12);
  EXPECT_NEAR(around["impulse"], 1.5 * impulse, 1e-12);
  EXPECT_NEAR(around["impulse_across"], 0.25 * impulse, 1e-12);
  EXPECT_NEAR(around["mean"], 1.5 * impulse / 0.4, 1e-9);
  const auto& side = json["walls"]["left"];
  EXPECT_EQ(side["maximum"], 2 + raw);
  EXPECT_NEAR(side["impulse"], 2 * 0.4 + impulse, 1e-12);
  EXPECT_NEAR(side["mean"], 2 + impulse / 0.4, 1e-9);
  EXPECT_FALSE(side.contains("impulse_across"));
}

// By what the material lost the synthetic wall bears 0.9 of its own force.
TEST(Summary, HasAllObstaclesTogetherByBothMeasures) {
  const TemporaryFolder folder;
  record(SyntheticRun(Mode::coupled), folder / "a");
  const auto json = nlohmann::json::parse(read_text(folder / "a/summary.json"));
  const auto &all = json["obstacles_together"], &wall = json["obstacles"]["wall"];
  for (const char* figure : {"force_peak", "force_peak_time", "impulse"})
    EXPECT_NEAR(all["own"][figure], wall[figure].get<double>(), 1e-12) << figure;
  for (const char* figure : {"force_peak", "force_mean", "impulse"})
    EXPECT_NEAR(all["control_volume"][figure], 0.9 * all["own"][figure].get<double>(), 1e-12) << figure;
  EXPECT_NEAR(all["difference"]["largest"], -0.1 * wall["force_peak"].get<double>(), 1e-12);
  EXPECT_EQ(all["difference"]["largest_time"], wall["force_peak_time"]);
  EXPECT_NEAR(all["difference"]["mean"], -0.1 * wall["impulse"].get<double>() / 0.4, 1e-12);
  EXPECT_NEAR(all["difference"]["relative"], 0.1, 1e-12);
}

TEST(Summary, HasTheNoiseOfTheCoupling) {
  const TemporaryFolder folder;
  record(SyntheticRun(Mode::coupled), folder / "a");
  record(SyntheticRun(Mode::continuum), folder / "b");
  const auto noise = nlohmann::json::parse(read_text(folder / "a/summary.json"))["coupling_noise"];
  EXPECT_NEAR(noise["window_frequency"], 1000, 1e-9);
  EXPECT_NEAR(noise["sampling_frequency"], 8000, 1e-9);
  const auto& wall = noise["obstacles"]["wall"];
  EXPECT_EQ(wall["peak_over_neighbours"], noise["peak_over_neighbours"]);
  EXPECT_GT(wall["peak_over_neighbours"], 10);
  EXPECT_NEAR(wall["rms"], 3 / std::sqrt(2), 0.03);
  ASSERT_EQ(wall["harmonics"].size(), 3u);
  EXPECT_NEAR(wall["harmonics"][1]["frequency"], 2000, 1e-9);
  EXPECT_GT(wall["segments"], 4);
  EXPECT_FALSE(nlohmann::json::parse(read_text(folder / "b/summary.json")).contains("coupling_noise"));
}

TEST(Summary, HasTheStressesOnGauges) {
  const TemporaryFolder folder;
  SyntheticRun run(Mode::coupled);
  run.stresses = true;
  run.scene.stress_gauges = {{"middle", 0, 0, 0.03, 0, 0, 0.02}, {"unread", 0, 0.05, 0.03, 0.01, 0.01, 0}};
  record(run, folder / "a");
  const auto wall = nlohmann::json::parse(read_text(folder / "a/summary.json"))["obstacles"]["wall"];
  const auto& middle = wall["gauges"]["middle"];
  EXPECT_EQ(middle["area"], 1.5e-3);
  EXPECT_NEAR(middle["first_contact"], 0.1, 1e-9);
  for (const auto& [stress, times] : {std::pair{"normal", 2.0}, {"shear_up", -0.5}, {"shear_across", 0.1}}) {
    const std::string of = stress;
    for (const char* figure : {"peak", "mean", "final"})
      EXPECT_NEAR(middle[of + "_" + figure], times * wall[std::string("force_") + figure].get<double>(), 1e-12) << of << figure;
    EXPECT_NEAR(middle[of + "_impulse"], times * wall["impulse"].get<double>(), 1e-12);
    EXPECT_EQ(middle[of + "_peak_time"], wall["force_peak_time"]);
  }
  ASSERT_TRUE(wall["gauges"].contains("unread"));
  EXPECT_EQ(wall["gauges"]["unread"].size(), middle.size());
  for (const auto& figure : wall["gauges"]["unread"]) EXPECT_TRUE(figure.is_null());
  const std::string csv = read_text(folder / "a/forces.csv");
  EXPECT_THAT(csv,
              HasSubstr(",left wall y [N],wall middle normal [Pa],wall middle up [Pa],wall middle across [Pa],together x [N],"
                        "together by control volume x [N]\n"));
  std::istringstream lines(csv);
  std::string line;
  while (std::getline(lines, line) && line.substr(0, 3) != "0.2") {
  }
  std::istringstream cells(line);
  std::vector<double> row;
  for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  ASSERT_EQ(row.size(), 13u);
  EXPECT_NEAR(row[8], 2 * row[1], 1e-6);
  EXPECT_NEAR(row[9], -0.5 * row[1], 1e-6);
  EXPECT_NEAR(row[10], 0.1 * row[1], 1e-6);
  EXPECT_NEAR(row[11], row[1], 1e-6);
  EXPECT_NEAR(row[12], 0.9 * row[1], 1e-6);
}

TEST(Summary, TellsOfAnInterruptedRun) {
  const TemporaryFolder folder;
  Summary summary(folder / "summary.json");
  SyntheticRun(Mode::continuum).play({&summary}, 0, 0.05, true, "interrupted");
  const auto json = nlohmann::json::parse(read_text(folder / "summary.json"));
  EXPECT_EQ(json["status"], "interrupted");
  EXPECT_EQ(json["reason"], "stopped by the user");
  EXPECT_EQ(json["engine"], "");
  EXPECT_TRUE(json["obstacles"]["wall"]["first_contact"].is_null());
  EXPECT_EQ(json["grains"]["peak_count"], 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "summary.json.tmp"));
}

TEST(Summary, OfAContinuedRunIsThatOfTheWhole) {
  for (const bool planes : {false, true}) {
    const TemporaryFolder folder;
    SyntheticRun run(planes ? Mode::continuum : Mode::coupled);
    run.planes = planes;
    run.stresses = !planes;
    record(run, folder / "a");
    run.checkpoint_at = 0.15;
    Summary broken(folder / "broken.json"), summary(folder / "continued.json");
    run.play({&broken}, 0, 0.3, false);
    run.play({&summary}, 0.15);
    auto whole = nlohmann::json::parse(read_text(folder / "a/summary.json"));
    auto continued = nlohmann::json::parse(summary.text());
    continued.erase("resumed"), whole.erase("resumed");
    EXPECT_EQ(continued, whole);
    const auto& wall = whole["obstacles"]["wall"];
    ASSERT_EQ(wall.contains("overflow"), planes);
    if (!planes) continue;
    EXPECT_NEAR(wall["overflow"], 0.04, 1e-15);
    EXPECT_NEAR(wall["max_heap"], 0.05, 1e-15);
    EXPECT_NEAR(wall["max_climbed"], 0.08, 1e-15);
  }
}

// A film, a chute and an avalanche: a gauge reads the same in shares of the release.
TEST(Summary, GaugesScaleWithTheScene) {
  for (const double size : {0.005, 0.1, 100.0}) {
    const TemporaryFolder folder;
    SyntheticRun run(Mode::continuum);
    run.scene.release.height = size;
    run.scene.record.gauges = {{"mid", 0.5, 0, 0, 0}, {"far", 1, 0, 0, 0}};
    Summary summary(folder / "summary.json");
    const RunStart begin = run.start();
    summary.on_start(begin);
    // A forerunner that is fast and thin, then the front; far away nothing but the forerunner.
    const double depths[] = {0, 0.0099, 0.0101, 0.3, 0.2}, speeds[] = {0, 9, 1, 2, 1};
    for (long k = 0; k < 5; ++k) {
      WindowReport w = run.window(k);
      w.gauges = {{size * depths[k], speeds[k], 0}, {size * std::min(depths[k], 0.0099), speeds[k], 0}};
      summary.on_window(w);
    }
    summary.on_finish({});
    const auto gauges = nlohmann::json::parse(summary.text())["gauges"];
    EXPECT_NEAR(gauges["mid"]["arrival"], 0.003, 1e-12) << size;
    EXPECT_EQ(gauges["mid"]["max_speed"], 2) << size;
    EXPECT_NEAR(gauges["mid"]["depth_mean"], size * 0.5101 / 3, 1e-12 * size);
    EXPECT_TRUE(gauges["far"]["arrival"].is_null()) << size;
  }
}

std::vector<std::string> lines_of(const std::string& path) {
  std::istringstream in(read_text(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(ForcesCsv, HasUnitsAndARowEachInterval) {
  const TemporaryFolder folder;
  SyntheticRun run(Mode::coupled);
  run.scene.record.forces = 0.003;
  ForcesCsv csv(folder / "forces.csv");
  run.play({&csv});
  const std::vector<std::string> lines = lines_of(folder / "forces.csv");
  EXPECT_EQ(lines[0],
            "time [s],wall x [N],wall y [N],wall z [N],wall control_volume x [N],wall control_volume y [N],"
            "left wall x [N],left wall y [N],together x [N],together by control volume x [N]");
  EXPECT_EQ(lines[1], "0.003,0,0,0,0,0,0.125,-2,0,0");
  ASSERT_EQ(lines.size(), 1u + 134u);  // 133 whole intervals and the rest
  double impulse = 0, expected = 0, before = 0;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    double t = 0, x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(lines[k].c_str(), "%lf,%lf,%lf,%lf", &t, &x, &y, &z), 4) << lines[k];
    impulse += x * (t - before);
    before = t;
  }
  for (long k = 0; k < SyntheticRun::windows; ++k) expected += run.window(k).obstacles[0].force[0] * 1e-3;
  EXPECT_NEAR(impulse, expected, 1e-8);
}

std::string what_is_shown(bool terminal, bool quiet, const std::string& log) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  {
    Console console(log, {out, terminal, quiet});
    SyntheticRun(Mode::coupled).play({&console});
  }
  std::fclose(out);
  const std::string shown(text, size);
  std::free(text);
  return shown;
}

TEST(Console, ShowsEventsAndTheEnd) {
  const TemporaryFolder folder;
  const std::string plain = what_is_shown(false, false, folder / "plain.txt");
  EXPECT_THAT(plain, HasSubstr("Heap onto a wall (coupled mode), 0.4 s to simulate\n"));
  EXPECT_THAT(plain, HasSubstr("0.100 s: the flow reaches the wall: its front is 1 mm from it\n"));
  EXPECT_THAT(plain, HasSubstr("t = 0.400 s of 0.4 s (100 %)  step 400  cells 7500  grains 4000"));
  EXPECT_THAT(plain, HasSubstr("done after 12 s (20 s of processor time)\n"));
  EXPECT_EQ(plain.find('\r'), std::string::npos);
}

TEST(Console, IsQuietButLogs) {
  const TemporaryFolder folder;
  EXPECT_EQ(what_is_shown(false, true, folder / "log.txt"), "");
  EXPECT_THAT(read_text(folder / "log.txt"), HasSubstr("the zone grows to 220 mm"));
}

TEST(Console, OverwritesOnATerminal) {
  const TemporaryFolder folder;
  const std::string shown = what_is_shown(true, false, folder / "log.txt");
  EXPECT_NE(shown.find("\rt = 0.400 s"), std::string::npos);
  EXPECT_EQ(read_text(folder / "log.txt").find('\r'), std::string::npos);
}

TEST(Console, SaysDurationsInWords) {
  EXPECT_EQ(in_words(12.4), "12 s");
  EXPECT_EQ(in_words(200), "3 min 20 s");
  EXPECT_EQ(in_words(3720), "1 h 02 min");
}

}  // namespace
}  // namespace couloir::testing
