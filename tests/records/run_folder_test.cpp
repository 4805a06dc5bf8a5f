#include "coupling/records/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "coupling/records/text_file.hpp"
#include "coupling/scene/scene_error.hpp"
#include "synthetic_run.hpp"

namespace couloir::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct RunFolders : ::testing::Test {
  std::string error(const std::string& out) {
    try {
      RunFolder::create(scene, out, "a: 1");
    } catch (const SceneError& e) {
      return e.what();
    }
    return "";
  }
  TemporaryFolder folder;
  Scene scene = SyntheticRun(Mode::coupled).scene;
};

TEST_F(RunFolders, AreMadeWithTheScene) {
  const RunFolder run = RunFolder::create(scene, folder / "a/b/c", "title: x");
  EXPECT_EQ(read_text(run.file("scene.yaml")), "title: x\n");
  EXPECT_EQ(run.path(), fs::path(folder / "a/b/c"));
}

TEST_F(RunFolders, CountUpBesideTheScene) {
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  EXPECT_EQ(RunFolder::create(scene, "", "").path(), fs::path("runs/heap-coupled"));
  EXPECT_EQ(RunFolder::create(scene, "", "").path(), fs::path("runs/heap-coupled-2"));
  EXPECT_EQ(RunFolder::create(scene, "", "").path(), fs::path("runs/heap-coupled-3"));
  fs::current_path(before);
}

TEST_F(RunFolders, AreNamedAfterTheExperiment) {
  for (const char* file : {"experiments/dam/scene.yaml", "experiments/dam", "experiments/dam/", "dam.yaml"}) {
    scene.file = file;
    EXPECT_EQ(scene_name(scene), "dam") << file;
  }
}

TEST_F(RunFolders, AreNotOverwritten) {
  fs::create_directories(folder / "full");
  std::ofstream(folder / "full/thesis.tex") << "years of work";
  EXPECT_EQ(error(folder / "full"), (folder / "full") + " exists and is not empty; choose another --out or remove it");
  fs::create_directories(folder / "empty");
  EXPECT_EQ(error(folder / "empty"), "");
}

TEST_F(RunFolders, AskForAnotherPlaceWhereAFileStands) {
  std::ofstream(folder / "file") << "x";
  EXPECT_THAT(error(folder / "file"), AllOf(HasSubstr("is a file"), HasSubstr("choose another --out")));
  EXPECT_THAT(error(folder / "file/below"), AllOf(HasSubstr("is a file"), HasSubstr("choose another --out")));
}

TEST_F(RunFolders, AskForAnotherPlaceWhereNothingCanBeWritten) {
  // For root, whom no permission stops, /proc is such a place.
  std::string place = "/proc/run";
  if (geteuid() != 0) {
    fs::create_directories(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    place = folder / "locked/run";
  }
  EXPECT_THAT(error(place), AllOf(HasSubstr(place + " cannot be made: "), HasSubstr("choose another --out")));
}

TEST_F(RunFolders, OpenOnlyRuns) {
  EXPECT_THROW(RunFolder::open(folder / "none"), SceneError);
  EXPECT_THROW(RunFolder::open(folder.path()), SceneError);
  std::ofstream(folder / "records.h5") << "x";
  EXPECT_EQ(RunFolder::open(folder.path()).file("forces.csv"), folder / "forces.csv");
}

}  // namespace
}  // namespace couloir::testing
