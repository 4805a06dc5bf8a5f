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
  for (const char* wrong : {"http://", "https://", "<script", "None", "nan", "src=\"/", "href="})
    EXPECT_THAT(text, Not(HasSubstr(wrong)));
  for (const char* name : {"top.png", "side.png", "forces.png", "ledger.png", "counts.png"})
    expect_picture(folder / (std::string("a/report/") + name));
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

TEST_F(Report, OfWhatIsNoRunSaysSo) {
  ASSERT_EQ(report((folder / "nothing") + " 2> " + (folder / "told.txt")), 2);
  EXPECT_THAT(read_text(folder / "told.txt"), HasSubstr("nothing holds no records.h5"));
}

}  // namespace
}  // namespace couloir::testing
