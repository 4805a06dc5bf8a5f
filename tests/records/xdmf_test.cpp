// flow.xdmf and grains.xdmf: well-formed, and everything they refer to is in records.h5 with the size they say.
#include "coupling/records/xdmf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "coupling/records/h5.hpp"
#include "coupling/records/reader.hpp"
#include "coupling/records/records.hpp"
#include "coupling/records/text_file.hpp"
#include "synthetic_run.hpp"

namespace couloir::testing {
namespace {

// The names of the tags in order, "" where the tags do not nest.
std::vector<std::string> tags(const std::string& text) {
  static const std::regex tag("<(/?)([A-Za-z0-9]+)[^<>]*?(/?)>");
  std::vector<std::string> open, all;
  for (std::sregex_iterator it(text.begin(), text.end(), tag), end; it != end; ++it) {
    const bool closes = (*it)[1].length() > 0, empty = (*it)[3].length() > 0;
    if (closes) {
      if (open.empty() || open.back() != (*it)[2]) return {};
      open.pop_back();
    } else {
      all.push_back((*it)[2]);
      if (!empty) open.push_back((*it)[2]);
    }
  }
  return open.empty() ? all : std::vector<std::string>{};
}

int check_references(const std::string& folder, const std::string& name) {
  const std::string text = read_text(folder + "/" + name);
  const h5::Handle file = h5::open_file(folder + "/records.h5");
  static const std::regex item(
      "<DataItem Dimensions=\"([0-9 ]+)\" NumberType=\"(\\w+)\" Precision=\"(\\d)\" "
      "Format=\"HDF\">records.h5:([^<]+)</DataItem>");
  int found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), item), end; it != end; ++it, ++found) {
    std::istringstream dimensions((*it)[1]);
    hsize_t said = 1, there = 1;
    for (hsize_t n; dimensions >> n;) said *= n;
    const std::string path = (*it)[4];
    for (const hsize_t n : h5::shape_of(file, path)) there *= n;
    EXPECT_EQ(said, there) << path;
    const h5::Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), path);
    const h5::Handle type(H5Dget_type(set), path);
    EXPECT_EQ(H5Tget_size(type), std::stoul((*it)[3])) << path;
    EXPECT_EQ(H5Tget_class(type) == H5T_FLOAT, (*it)[2] == "Float") << path;
  }
  return found;
}

TEST(Xdmf, RefersToWhatIsThere) {
  const TemporaryFolder folder;
  const SyntheticRun run(Mode::coupled);
  record(run, folder.path());
  EXPECT_EQ(check_references(folder.path(), "flow.xdmf"), 11 * 5);
  int with_grains = 0;
  for (int k = 0; k <= 10; ++k) with_grains += run.grains(0.04 * k).size() > 0;
  EXPECT_GT(with_grains, 5);
  EXPECT_EQ(check_references(folder.path(), "grains.xdmf"), with_grains * 5);
  for (const char* name : {"flow.xdmf", "grains.xdmf"}) {
    const std::vector<std::string> found = tags(read_text(folder / name));
    ASSERT_FALSE(found.empty()) << name;
    EXPECT_EQ(found[0], "Xdmf");
  }
}

TEST(Xdmf, IsCompleteWhileTheRunGoesOn) {
  const TemporaryFolder folder;
  Xdmf xdmf(folder.path());
  SyntheticRun(Mode::coupled).play({&xdmf}, 0, 0.2, false);
  const std::vector<std::string> found = tags(read_text(folder / "flow.xdmf"));
  EXPECT_EQ(std::count(found.begin(), found.end(), "Time"), 6);
}

TEST(Xdmf, LeavesOutWhatTheModeHasNot) {
  const TemporaryFolder folder;
  record(SyntheticRun(Mode::continuum), folder / "flow");
  record(SyntheticRun(Mode::grains), folder / "grains");
  EXPECT_TRUE(std::filesystem::exists(folder / "flow/flow.xdmf"));
  EXPECT_FALSE(std::filesystem::exists(folder / "flow/grains.xdmf"));
  EXPECT_FALSE(std::filesystem::exists(folder / "grains/flow.xdmf"));
  EXPECT_TRUE(std::filesystem::exists(folder / "grains/grains.xdmf"));
}

// The level frame: the free surface lies h + bed above the surface, and at rest on the incline the flow has no upward normal
// speed.
TEST(Xdmf, DrawsTheFreeSurfaceInTheLevelFrame) {
  const TemporaryFolder folder;
  const SyntheticRun run(Mode::continuum);
  record(run, folder.path());
  const h5::Handle file = h5::open_file(folder / "records.h5");
  const std::vector<double> points = h5::numbers(file, "frames/000003/surface"), h = run.depth(0.12);
  const int i = 40, j = 25;
  const std::size_t k = std::size_t(j) * run.grid.nx + i;
  ASSERT_GT(h[k], 0.01);
  const Eigen::Vector3d expected = run.surface.to_level(run.surface.to_space({run.grid.x(i), run.grid.y(j), h[k]}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(points[3 * k + c], expected[c], 1e-6);
  const std::vector<double> v = h5::numbers(file, "frames/000003/velocity");
  EXPECT_LT(v[3 * k + 2], 0) << "downslope is downward";
  EXPECT_NEAR(std::hypot(v[3 * k], v[3 * k + 2]), 0.5 + 1.8 * 0.12, 1e-6);
}

// What is thin is so beside the release, whatever its size.
TEST(Xdmf, ShowsNoVelocityOfWhatIsThinForTheScene) {
  for (const double size : {0.005, 0.1, 100.0}) {
    const TemporaryFolder folder;
    SyntheticRun run(Mode::continuum);
    run.scene.release.height = size;
    run.grid = {4, 1, 0.3, 0.3, 0, -0.15};
    {
      Records records(folder / "records.h5", "title: Thin flow\n");
      const RunStart begin = run.start();
      records.on_start(begin);
      const std::vector<double> h{0, 0.9e-5 * size, 1.1e-5 * size, size}, hu{0, 2 * h[1], 2 * h[2], 2 * h[3]}, hv(4, 0.0);
      FrameView view;
      view.h = &h, view.hu = &hu, view.hv = &hv;
      records.on_frame(view);
    }
    const h5::Handle file = h5::open_file(folder / "records.h5");
    const std::vector<double> v = h5::numbers(file, "frames/000000/velocity");
    const double expected[] = {0, 0, 2, 2};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(std::hypot(v[3 * i], v[3 * i + 2]), expected[i], 1e-6) << size << ", cell " << i;
  }
}

}  // namespace
}  // namespace couloir::testing
