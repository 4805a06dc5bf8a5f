// Checkpoints that a run does not go on from: of another scene or program, damaged, in use, or none.

#include <gmock/gmock.h>

#include "coupling/checkpoint/checkpoint_error.hpp"
#include "coupling/checkpoint/checkpoint_folder.hpp"
#include "coupling/scene/scene_error.hpp"
#include "recorded_run.hpp"

namespace couloir {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <class Error, class F>
std::string sentence(F&& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "no such error";
}

struct Refused : testing::Test {
  RecordedRun run{"refused", small_scene("continuum")};
  void SetUp() override { ASSERT_EQ(run.go(false, 100).status, "interrupted"); }
  void goes_on() { EXPECT_EQ(run.go(true).status, "done"); }
};

TEST_F(Refused, OfAnotherRevision) {
  run.options.made_by = "that program";
  EXPECT_THAT(sentence<SceneError>([&] { run.go(true); }),
              AllOf(HasSubstr("was made by couloir this program, and this is that program"), HasSubstr("start the run anew")));
  run.options.made_by = "this program";
  goes_on();
}

TEST_F(Refused, OfAnotherScene) {
  const Scene scene = run.scene;
  run.scene = small_scene("continuum", {{"continuum.cfl", "0.4"}});
  EXPECT_THAT(sentence<SceneError>([&] { run.go(true); }),
              AllOf(HasSubstr("the scene has changed since the checkpoint"), HasSubstr("0.4' was '"), HasSubstr("0.45'")));
  run.scene = scene;
  goes_on();
}

TEST_F(Refused, Damaged) {
  const std::string file = run.options.checkpoints + "/state";
  const std::string good = read_text(file);
  std::string bad = good;
  bad[bad.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << bad;
  EXPECT_THAT(sentence<CheckpointError>([&] { run.go(true); }), HasSubstr("its bytes are not those that were written"));
  std::ofstream(file, std::ios::binary) << good.substr(0, 100);
  EXPECT_THAT(sentence<CheckpointError>([&] { run.go(true); }), HasSubstr("is cut short"));
  std::ofstream(file, std::ios::binary) << "something else altogether";
  EXPECT_THAT(sentence<CheckpointError>([&] { run.go(true); }), HasSubstr("cannot be read"));
  std::ofstream(file, std::ios::binary) << good;
  goes_on();
}

TEST_F(Refused, InUse) {
  {
    CheckpointFolder other(run.options.checkpoints);
    ASSERT_TRUE(other.lock());
    EXPECT_THAT(sentence<SceneError>([&] { run.go(true); }), HasSubstr("another process is at this run"));
  }
  goes_on();
}

TEST_F(Refused, WithRecordsThatAreNotItsOwn) {
  std::filesystem::resize_file(run.folder + "/records.h5", 1000);
  EXPECT_THAT(sentence<RecordError>([&] { run.go(true); }), HasSubstr("is shorter than it was at the checkpoint"));
}

TEST_F(Refused, WithoutOne) {
  std::filesystem::remove(run.options.checkpoints + "/state");
  EXPECT_THAT(sentence<CheckpointError>([&] { run.go(true); }), HasSubstr("state does not exist"));
}

// New grains would be cut from it.
TEST(Refusal, WhereThePackingIsAnother) {
  RecordedRun grains("other_packing", small_scene("grains", {{"duration", "20 ms"}, {"record.checkpoint", "2 ms"}}));
  ASSERT_EQ(grains.go(false, 5).status, "interrupted");
  const std::string good = grains.options.packings;
  grains.options.packings = fresh_folder("other_packings");
  for (const auto& entry : std::filesystem::directory_iterator(good)) {
    std::string text = read_text(entry.path());
    const std::size_t digit = text.rfind('.') + 4;
    text[digit] = text[digit] == '1' ? '2' : '1';
    std::ofstream(std::filesystem::path(grains.options.packings) / entry.path().filename()) << text;
  }
  EXPECT_THAT(sentence<CheckpointError>([&] { grains.go(true); }), HasSubstr("is not the one that the run began with"));
  grains.options.packings = good;
  EXPECT_EQ(grains.go(true).status, "done");
}

}  // namespace
}  // namespace couloir
