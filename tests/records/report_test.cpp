// app/report on recorded runs: the page exists, needs nothing from elsewhere, and says the key figures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "coupling/records/text_file.hpp"
#include "synthetic_run.hpp"

namespace couloir::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kPython = "/usr/bin/python3";

int report(const std::string& arguments) {
  const std::string command = std::string(kPython) + " " COULOIR_SOURCE_DIR "/app/report/report.py " + arguments;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// The page without its embedded pictures, whose letters may spell anything.
std::string without_pictures(const std::string& page) {
  std::string text;
  std::size_t at = 0;
  for (auto begin = page.find("base64,"); begin != std::string::npos; begin = page.find("base64,", at)) {
    text += page.substr(at, begin - at);
    at = page.find('"', begin);
  }
  return text + page.substr(at);
}

struct Report : ::testing::Test {
  void SetUp() override {
    if (std::system((std::string(kPython) + " -c 'import h5py, matplotlib' 2> /dev/null").c_str()) != 0)
      GTEST_SKIP() << "python3-h5py or python3-matplotlib is not installed";
  }
  void expect_picture(const std::string& path) {
    ASSERT_TRUE(std::filesystem::exists(path)) << path;
    EXPECT_GT(std::filesystem::file_size(path), 5000u) << path;
    EXPECT_EQ(read_text(path).substr(1, 3), "PNG");
  }
  TemporaryFolder folder;
};

TEST_F(Report, OfOneRun) {
  record(SyntheticRun(Mode::coupled), folder / "a");
  ASSERT_EQ(report(folder / "a"), 0);
  const std::string page = read_text(folder / "a/report/index.html");
  const auto summary = nlohmann::json::parse(read_text(folder / "a/summary.json"));
  char peak[32];
  std::snprintf(peak, sizeof peak, "%.1f", summary["obstacles"]["wall"]["force_peak"].get<double>());
  EXPECT_THAT(page, HasSubstr(peak));
  for (const char* text : {"Heap onto a wall", "coupled", "LIGGGHTS 3.8.0", "earth pressure", "grains are spheres",
                           "the zone grows to 220 mm", "data:image/png;base64,"})
    EXPECT_THAT(page, HasSubstr(text));
  const std::string text = without_pictures(page);
  EXPECT_LT(text.size(), 20000u);
  for (const char* wrong : {"http://", "https://", "None", "nan", "src=\"/", "href="}) EXPECT_THAT(text, Not(HasSubstr(wrong)));
  for (const char* name :
       {"top.png", "terrain.png", "side.png", "forces.png", "control_volume.png", "spectrum.png", "ledger.png", "counts.png"})
    expect_picture(folder / (std::string("a/report/") + name));
}

TEST_F(Report, ShowsStressesOnGauges) {
  SyntheticRun run(Mode::grains);
  run.stresses = true;
  run.scene.stress_gauges = {{"middle", 0, 0, 0.03, 0, 0, 0.02}};
  record(run, folder / "a");
  ASSERT_EQ(report(folder / "a"), 0);
  expect_picture(folder / "a/report/stresses.png");
  const auto summary = nlohmann::json::parse(read_text(folder / "a/summary.json"));
  char peak[32];
  std::snprintf(peak, sizeof peak, "%.1f", summary["obstacles"]["wall"]["gauges"]["middle"]["normal_peak"].get<double>());
  for (const std::string& text : {std::string(peak), std::string("Stress on gauge middle of wall")})
    EXPECT_THAT(without_pictures(read_text(folder / "a/report/index.html")), HasSubstr(text));
  record(SyntheticRun(Mode::continuum), folder / "b");
  ASSERT_EQ(report((folder / "a") + " " + (folder / "b") + " --out " + (folder / "both")), 0);
  expect_picture(folder / "both/stresses.png");
  ASSERT_EQ(report(folder / "b"), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "b/report/stresses.png"));
}

TEST_F(Report, OfARefinedMesh) {
  SyntheticRun run(Mode::continuum);
  run.refined = true;
  record(run, folder / "a");
  ASSERT_EQ(report(folder / "a"), 0);
  EXPECT_THAT(read_text(folder / "a/report/index.html"), HasSubstr("The mesh over the flow"));
  expect_picture(folder / "a/report/mesh.png");
  expect_picture(folder / "a/report/top.png");
  record(SyntheticRun(Mode::continuum), folder / "b");
  ASSERT_EQ(report(folder / "b"), 0);
  EXPECT_THAT(read_text(folder / "b/report/index.html"), Not(HasSubstr("The mesh over the flow")));
  ASSERT_EQ(report((folder / "a") + " " + (folder / "b") + " --out " + (folder / "both")), 0);
  expect_picture(folder / "both/depth.png");
}

// What the pictures draw: coarser cells under finer ones, in the box, no finer than asked; the outermost cells whole.
TEST_F(Report, DrawsTheFinestCells) {
  SyntheticRun run(Mode::continuum);
  run.refined = true;
  record(run, folder / "a");
  const std::string program = std::string(kPython) +
                              " -c \"import sys; sys.path.insert(0, '" COULOIR_SOURCE_DIR
                              "/app/report'); import numpy as np; from figures import extent; from read import Run\n"
                              "run = Run('" +
                              (folder / "a") +
                              "'); frame = run.frames[3]; blocks = list(frame.blocks())\n"
                              "x, y, h = run.finest_depth(frame, (0.4, 0.7, -0.2, 0.2))\n"
                              "assert abs(x[1] - x[0] - 0.0025) < 1e-12 and abs(y[1] - y[0] - 0.0025) < 1e-12\n"
                              "at = lambda a, b: h[np.argmin(abs(y - b)), np.argmin(abs(x - a))]\n"
                              "assert at(0.50125, -0.04875) == blocks[2][3][0, 0]\n"
                              "assert at(0.4525, -0.0975) == blocks[1][3][0, 0], 'level 1'\n"
                              "assert at(0.425, 0.105) == frame.flow('h')[35, 42], 'level 0'\n"
                              "x, y, h = run.finest_depth(frame, (0.4, 0.7, -0.2, 0.2), most=100)\n"
                              "assert abs(x[1] - x[0] - 0.005) < 1e-12\n"
                              "assert abs(at(0.5025, -0.0475) - blocks[2][3][:2, :2].mean()) < 1e-15\n"
                              "x, y, h = run.finest_depth(frame, (-1, 9, -9, 9))\n"
                              "assert h.shape == (200, 600) and abs(x[0] - 0.00125) < 1e-9\n"
                              "x, y, _ = run.grid; run.obstacles = {}\n"
                              "run.depth = lambda frame: (x, y, np.full((len(y), len(x)), 0.01))\n"
                              "assert np.allclose(extent(run, run.frames), (0, 1.5, -0.25, 0.25)), extent(run, run.frames)\"";
  EXPECT_EQ(std::system(program.c_str()), 0);
}

TEST_F(Report, OfTheOtherModes) {
  record(SyntheticRun(Mode::continuum), folder / "flow");
  record(SyntheticRun(Mode::grains), folder / "grains");
  ASSERT_EQ(report((folder / "flow") + " --out " + (folder / "flow-report")), 0);
  ASSERT_EQ(report((folder / "grains") + " --out " + (folder / "grains-report")), 0);
  expect_picture(folder / "flow-report/top.png");
  expect_picture(folder / "grains-report/top.png");
  expect_picture(folder / "grains-report/side.png");
  EXPECT_THAT(read_text(folder / "flow-report/index.html"), Not(HasSubstr("engine steps")));
}

TEST_F(Report, OfSeveralRunsSideBySide) {
  record(SyntheticRun(Mode::grains), folder / "grains");
  record(SyntheticRun(Mode::coupled, 1.1), folder / "coupled");
  record(SyntheticRun(Mode::continuum, 0.8), folder / "flow");
  ASSERT_EQ(report((folder / "grains") + " " + (folder / "coupled") + " " + (folder / "flow")), 0);
  const std::string page = read_text(folder / "report/index.html");
  for (const char* text : {"1.10", "0.80", "grains", "coupled", "continuum"}) EXPECT_THAT(page, HasSubstr(text));
  expect_picture(folder / "report/forces.png");
  expect_picture(folder / "report/depth.png");
}

// Nothing is fetched; the slider has the frames that were told, its marker is at their times, and the side view holds what flies.
TEST_F(Report, TurnsThroughTheFrames) {
  record(SyntheticRun(Mode::coupled), folder / "coupled");
  record(SyntheticRun(Mode::grains, 1.1), folder / "grains");
  record(SyntheticRun(Mode::continuum, 0.8), folder / "flow");
  const std::string command = std::string(kPython) +
                              " " COULOIR_SOURCE_DIR "/tests/records/pages_test.py " COULOIR_SOURCE_DIR "/app/report " +
                              (folder / "coupled") + " " + (folder / "grains") + " " + (folder / "flow");
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(Report, OfWhatIsNoRunSaysSo) {
  ASSERT_EQ(report((folder / "nothing") + " 2> " + (folder / "told.txt")), 2);
  EXPECT_THAT(read_text(folder / "told.txt"), HasSubstr("nothing holds no records.h5"));
}

}  // namespace
}  // namespace couloir::testing
