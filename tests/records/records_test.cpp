#include "coupling/records/records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "coupling/checkpoint/safe_file.hpp"
#include "coupling/records/columns.hpp"
#include "coupling/records/compare.hpp"
#include "coupling/records/forces_csv.hpp"
#include "coupling/records/reader.hpp"
#include "coupling/records/summary.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/records/xdmf.hpp"
#include "synthetic_run.hpp"

namespace couloir::testing {
namespace {

TEST(Records, ComeBackBitForBit) {
  const TemporaryFolder folder;
  const SyntheticRun run(Mode::coupled);
  record(run, folder / "a");
  const RecordsReader reader(folder / "a/records.h5");

  EXPECT_EQ(reader.frames(), (std::vector<long>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  const Frame frame = reader.frame(5);
  EXPECT_EQ(frame.time, 0.2);
  EXPECT_EQ(frame.h, run.depth(0.2));
  const Grains grains = run.grains(0.2);
  EXPECT_GT(grains.size(), 100u);
  EXPECT_EQ(frame.grains.id, grains.id);
  EXPECT_EQ(frame.grains.x, grains.x);
  EXPECT_EQ(frame.grains.vy, grains.vy);
  EXPECT_EQ(frame.grains.driven, grains.driven);

  for (const WindowColumn& c : window_columns()) {
    const std::vector<double> column = reader.window(c.name);
    ASSERT_EQ(column.size(), std::size_t(SyntheticRun::windows)) << c.name;
    for (const long k : {0, 150, 399}) EXPECT_EQ(column[k], c.value(run.window(k))) << c.name;
  }
  EXPECT_EQ(reader.obstacles(), std::vector<std::string>{"wall"});
  EXPECT_EQ(reader.force("wall", "fy")[200], run.window(200).obstacles[0].force[1]);
  const std::vector<double> samples = reader.force_samples("wall"), those = run.samples(run.window(200).time);
  ASSERT_EQ(samples.size(), std::size_t(8 * SyntheticRun::windows));
  EXPECT_TRUE(std::equal(those.begin(), those.end(), samples.begin() + 200 * 8));
  const std::vector<ForceMeasure> measures = reader.measures();
  ASSERT_EQ(measures.size(), 2u);
  EXPECT_EQ(measures[0].kind + " of " + measures[0].of, "control_volume of wall");
  EXPECT_EQ(measures[1].kind + " of " + measures[1].of, "wall of left");
  for (int m : {0, 1}) {
    EXPECT_EQ(reader.measure(measures[m], "fx")[200], run.window(200).measures[m][0]);
    EXPECT_EQ(reader.measure(measures[m], "fy")[200], run.window(200).measures[m][1]);
  }
  const std::vector<Event> events = reader.events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].time, 0.1);
  EXPECT_EQ(events[0].what, "the flow reaches the wall: its front is 1 mm from it");
  EXPECT_EQ(reader.bed(), run.start().bed);
  EXPECT_EQ(reader.grid().nx, 150);
  EXPECT_NEAR(reader.grid().x0, 0.0, 1e-15);
  EXPECT_NEAR(reader.grid().dy, 0.01, 1e-15);
}

SyntheticRun refined_run(double scale = 1) {
  SyntheticRun run(Mode::continuum, scale);
  run.refined = true;
  return run;
}

TEST(Records, OfRefinedMeshesHoldTheBlocks) {
  const TemporaryFolder folder;
  const SyntheticRun run = refined_run();
  record(run, folder / "a");
  const RecordsReader reader(folder / "a/records.h5");
  for (const long k : {0L, 7L}) {
    const Frame frame = reader.frame(k);
    const BlocksView blocks = run.blocks(frame.time);
    EXPECT_EQ(frame.blocks.places, blocks.places);
    EXPECT_EQ(frame.blocks.h, blocks.h);
    EXPECT_EQ(frame.blocks.hu, blocks.hu);
    EXPECT_EQ(frame.blocks.hv, blocks.hv);
    EXPECT_EQ(frame.h, run.depth(frame.time)) << "the coarsest cells are where they always are";
  }
  EXPECT_NE(reader.frame(0).blocks.places, reader.frame(7).blocks.places);
}

TEST(Records, DifferencesOfBlocksAreSeen) {
  const TemporaryFolder folder;
  record(refined_run(), folder / "a");
  record(refined_run(), folder / "b");
  const auto changed = [&](const char* name) {
    record(refined_run(), folder / name);
    UndoJournal none;
    const h5::Handle file = h5::open_file(folder / (std::string(name) + "/records.h5"), none);
    const h5::Handle set(H5Dopen2(file, (std::string("frames/000007/blocks/") + name).c_str(), H5P_DEFAULT), name);
    std::vector<double> all(h5::numbers(file, std::string("frames/000007/blocks/") + name));
    all.back() += 1;
    h5::check(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), name);
    h5::flush(file, name);
  };
  changed("hv"), changed("j0");
  const RecordsReader a(folder / "a/records.h5"), b(folder / "b/records.h5"), hv(folder / "hv/records.h5"),
      j0(folder / "j0/records.h5");
  EXPECT_EQ(first_difference(a, b), "");
  EXPECT_TRUE(a.frame(7) == b.frame(7));
  EXPECT_EQ(first_difference(a, hv).substr(0, 38), "frames/000007/blocks/hv row 10299: 0.0");
  EXPECT_FALSE(a.frame(7) == hv.frame(7));
  EXPECT_EQ(first_difference(a, j0), "frames/000007/blocks: the refined cells are not in the same places");
  EXPECT_FALSE(a.frame(7) == j0.frame(7));
}

TEST(Records, NameWhatMadeThem) {
  const TemporaryFolder folder;
  record(SyntheticRun(Mode::coupled), folder / "a");
  const RecordsReader reader(folder / "a/records.h5");
  for (const char* name :
       {"couloir_version", "git_revision", "compiler", "compiler_flags", "cpu", "instruction_set", "libraries", "start_time"})
    EXPECT_NE(reader.text(name), "") << name;
  for (const char* library : {"HDF5 ", "Eigen ", "p4est ", "MPI "})
    EXPECT_THAT(reader.text("libraries"), ::testing::HasSubstr(library));
  EXPECT_EQ(reader.text("scene"), "title: Heap onto a wall\n# complete\n");
  EXPECT_EQ(reader.text("status"), "done");
  EXPECT_EQ(reader.text("engine"), "LIGGGHTS 3.8.0");
  EXPECT_EQ(reader.number("seed"), 20011);
  EXPECT_EQ(reader.number("format_version"), Records::kFormatVersion);
}

// Every dataset of the file says its unit and what it is.
herr_t find_silent(hid_t parent, const char* name, const H5O_info_t* info, void* out) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const h5::Handle set(H5Dopen2(parent, name, H5P_DEFAULT), name);
  auto& [sets, silent] = *static_cast<std::pair<int, std::string>*>(out);
  ++sets;
  if (H5Aexists(set, "unit") <= 0 || H5Aexists(set, "description") <= 0) silent += std::string(name) + " ";
  return 0;
}

TEST(Records, ExplainEveryDataset) {
  const TemporaryFolder folder;
  SyntheticRun run(Mode::coupled);
  run.refined = run.stresses = true;
  record(run, folder / "a");
  const h5::Handle file = h5::open_file(folder / "a/records.h5");
  std::pair<int, std::string> found{0, ""};
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, find_silent, &found, H5O_INFO_BASIC);
  EXPECT_GT(found.first, 11 * 15);
  EXPECT_EQ(found.second, "");
}

// Records of before there were measures have none.
TEST(Records, WithoutMeasuresAreRead) {
  const TemporaryFolder folder;
  record(SyntheticRun(Mode::coupled), folder / "a");
  {
    UndoJournal none;
    const h5::Handle file = h5::open_file(folder / "a/records.h5", none);
    ASSERT_GE(H5Ldelete(file, "measures", H5P_DEFAULT), 0);
    ASSERT_GE(H5Ldelete(file, "stresses", H5P_DEFAULT), 0);
    h5::flush(file, "a");
  }
  EXPECT_TRUE(RecordsReader(folder / "a/records.h5").measures().empty());
  EXPECT_TRUE(RecordsReader(folder / "a/records.h5").stress_gauges().empty());
}

TEST(Records, OfGrainsAloneHaveNoFlow) {
  const TemporaryFolder folder;
  const SyntheticRun run(Mode::grains);
  record(run, folder / "a");
  const RecordsReader reader(folder / "a/records.h5");
  EXPECT_EQ(reader.grid().nx, 0);
  EXPECT_TRUE(reader.frame(3).h.empty());
  EXPECT_EQ(reader.frame(3).grains.size(), run.grains(0.12).size());
}

TEST(Records, OfTheSameRunAreTheSame) {
  const TemporaryFolder folder;
  record(SyntheticRun(Mode::coupled), folder / "a");
  record(SyntheticRun(Mode::coupled), folder / "b");
  record(SyntheticRun(Mode::coupled, 1.01), folder / "c");
  const RecordsReader a(folder / "a/records.h5"), b(folder / "b/records.h5"), c(folder / "c/records.h5");
  EXPECT_EQ(first_difference(a, b), "");
  EXPECT_EQ(first_difference(a, c).substr(0, 35), "windows/momentum_storage row 100: -");
}

TEST(Records, DifferencesOfStressesAreSeen) {
  const TemporaryFolder folder;
  SyntheticRun run(Mode::coupled);
  record(run, folder / "without");
  run.stresses = true;
  record(run, folder / "a");
  record(run, folder / "b");
  const std::string path = folder / "b/records.h5";
  const RecordsReader a(folder / "a/records.h5"), without(folder / "without/records.h5");
  EXPECT_EQ(first_difference(a, RecordsReader(path)), "");
  EXPECT_EQ(first_difference(a, without), "the stress gauges are not the same");
  {
    UndoJournal none;
    const h5::Handle file = h5::open_file(path, none);
    const h5::Handle set(H5Dopen2(file, "stresses/wall/middle/up", H5P_DEFAULT), "up");
    std::vector<double> all(h5::numbers(file, "stresses/wall/middle/up"));
    all[200] += 1;
    h5::check(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), "up");
    h5::flush(file, path);
  }
  EXPECT_EQ(first_difference(a, RecordsReader(path)).substr(0, 34), "stresses/wall/middle/up row 200: -");
}

// The run is killed outright in the middle of a stretch between two frames.
TEST(Records, StayReadableWhenTheRunIsKilled) {
  const TemporaryFolder folder;
  const SyntheticRun run(Mode::coupled);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Records records(folder / "records.h5", "scene");
    run.play({&records}, 0, 0.215, false);
    kill(getpid(), SIGKILL);
  }
  int state = 0;
  waitpid(child, &state, 0);
  ASSERT_TRUE(WIFSIGNALED(state));
  const RecordsReader reader(folder / "records.h5");
  EXPECT_EQ(reader.text("status"), "running");
  EXPECT_EQ(reader.frames().size(), 6u);
  EXPECT_EQ(reader.frame(5).h, run.depth(0.2));
  EXPECT_EQ(reader.window("time").size(), 200u);
}

// Made at 0.15 s, when a window waits for its row of forces.csv.
struct Broken {
  explicit Broken(const std::string& in, SyntheticRun& of) : folder(in), run(of) {
    std::filesystem::create_directories(folder);
    run.scene.record.forces = 0.004;
    run.checkpoint_at = 0.15;
  }
  // Until 0.35 s, after the second event; or on from the checkpoint to the end.
  void play(bool resumed) const {
    Records records(folder + "/records.h5", "scene", folder, resumed);
    ForcesCsv forces(folder + "/forces.csv", resumed);
    Xdmf xdmf(folder);
    Summary summary(folder + "/summary.json");
    if (resumed)
      run.play({&records, &forces, &xdmf, &summary}, 0.15);
    else
      run.play({&records, &forces, &xdmf, &summary}, 0, 0.35, true, "interrupted");
  }
  std::string folder;
  SyntheticRun& run;
};

void expect_same(const std::string& whole, const std::string& broken) {
  EXPECT_EQ(first_difference(RecordsReader(whole + "/records.h5"), RecordsReader(broken + "/records.h5")), "");
  for (const char* name : {"/forces.csv", "/flow.xdmf", "/grains.xdmf"})
    EXPECT_EQ(read_text(broken + name), read_text(whole + name)) << name;
  auto a = nlohmann::json::parse(read_text(whole + "/summary.json")),
       b = nlohmann::json::parse(read_text(broken + "/summary.json"));
  EXPECT_EQ(b["resumed"], nlohmann::json::parse(R"([{"time": 0.15, "reason": "resumed"}])"));
  a.erase("resumed"), b.erase("resumed");
  EXPECT_EQ(a, b);
}

// The same as the run in one piece.
TEST(Records, OfAContinuedRunAreThoseOfTheUnbrokenOne) {
  const TemporaryFolder folder;
  SyntheticRun run(Mode::coupled);
  run.planes = run.stresses = true;
  const Broken broken(folder / "broken", run);
  record(run, folder / "whole");
  broken.play(false);
  EXPECT_EQ(RecordsReader(folder / "broken/records.h5").text("status"), "interrupted");
  broken.play(true);
  expect_same(folder / "whole", broken.folder);
  const RecordsReader reader(folder / "broken/records.h5");
  EXPECT_EQ(reader.planes(), std::vector<std::string>{"wall"});
  EXPECT_EQ(reader.planes("wall", "heap")[300], run.window(300).obstacles[0].heap);
  EXPECT_EQ(reader.stress_gauges(), std::vector<std::string>{"wall/middle"});
  for (const auto& [column, times] : {std::pair{"normal", 2.0}, {"up", -0.5}, {"across", 0.1}})
    EXPECT_EQ(reader.stress("wall/middle", column)[300], times * run.force(run.window(300).time)) << column;
  EXPECT_EQ(reader.text("status"), "done");
  EXPECT_EQ(reader.text("resumed"), "at 0.15 s: resumed");
  EXPECT_EQ(reader.events().size(), 2u);
}

// Killed outright at any moment after the checkpoint, also in the middle of a write.
TEST(Records, OfARunKilledAnywhereGoOnFromTheCheckpoint) {
  const TemporaryFolder folder;
  SyntheticRun run(Mode::coupled);
  run.refined = true;
  const Broken broken(folder / "broken", run);
  record(run, folder / "whole");
  const std::string state = folder / "state";
  int killed = 0;
  for (int k = 0; k < 12; ++k) {
    std::filesystem::remove_all(broken.folder);
    std::filesystem::create_directories(broken.folder);
    std::filesystem::remove(state);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      struct Saver : Observer {  // the last to hear of it: what all have saved is then there
        const SyntheticRun& run;
        std::string file;
        Saver(const SyntheticRun& r, std::string f) : run(r), file(std::move(f)) {}
        void on_checkpoint(std::int64_t) override { write_safely(file, run.saved); }
      } saver(run, state);
      Records records(broken.folder + "/records.h5", "scene", broken.folder);
      ForcesCsv forces(broken.folder + "/forces.csv");
      Xdmf xdmf(broken.folder);
      Summary summary(broken.folder + "/summary.json");
      run.play({&records, &forces, &xdmf, &summary, &saver});
      _exit(0);
    }
    for (int n = 0; n < 100000 && !std::filesystem::exists(state); ++n) usleep(100);
    usleep(1700 * k);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    killed += WIFSIGNALED(status);
    std::ifstream in(state, std::ios::binary);
    run.saved.assign(std::istreambuf_iterator<char>(in), {});
    broken.play(true);
    expect_same(folder / "whole", broken.folder);
  }
  EXPECT_GT(killed, 3);
}

}  // namespace
}  // namespace couloir::testing
