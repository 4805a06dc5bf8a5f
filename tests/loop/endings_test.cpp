// Runs that do not end by themselves: observers hear of it, and the state is on disk.

#include <gmock/gmock.h>

#include <csignal>

#include "continuum/errors.hpp"
#include "coupling/engine/engine_error.hpp"
#include "small_run.hpp"

namespace couloir {
namespace {

TEST(Endings, AKilledWorkerEndsTheRunWithItsStateSaved) {
  const std::string folder = fresh_folder("killed");
  RunOptions options = options_in(folder);
  options.on_engine = [](const GrainEngine& engine) { ::kill(engine.worker_pid(), SIGKILL); };
  Watched watched;
  try {
    run_scene(small_scene("coupled"), options, {&watched});
    FAIL() << "the run went on without its engine";
  } catch (const EngineError& error) {
    EXPECT_NE(std::string(error.what()).find("signal 9"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(watched.finished);
  EXPECT_EQ(watched.end.status, "failed");
  EXPECT_FALSE(watched.windows.empty()) << "what came before is told";
  EXPECT_TRUE(std::filesystem::exists(folder + "/continuum.state"));
}

TEST(Endings, AnInterruptEndsTheRunWithItsStateSaved) {
  const std::string folder = fresh_folder("interrupted");
  RunOptions options = options_in(folder);
  int asked = 0;
  options.interrupted = [&] { return ++asked > 100; };
  const Watched run = watch(small_scene("coupled"), options);
  EXPECT_EQ(run.end.status, "interrupted");
  EXPECT_EQ(run.windows.size(), 101u);
  EXPECT_TRUE(std::filesystem::exists(folder + "/continuum.state"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/engine.state"));
}

// What the run says when the numbers leave the solver's range, and that the state is kept.
std::string numerics_failure(const std::string& name, const Overrides& change) {
  const std::string folder = fresh_folder(name);
  Watched watched;
  try {
    run_scene(small_scene("continuum", change), options_in(folder), {&watched});
  } catch (const NumericsError& error) {
    EXPECT_TRUE(watched.finished);
    EXPECT_EQ(watched.end.status, "failed");
    EXPECT_EQ(watched.end.reason, error.what());
    EXPECT_GT(std::filesystem::file_size(folder + "/continuum.state"), 1000u);
    return error.what();
  }
  return "";
}

// A flow so heavy or so deep that it would take for ever to compute.
TEST(Endings, ARunawayEndsTheRunNamingThePlaceWithTheStateSaved) {
  for (const Overrides& change : {Overrides{{"gravity", "1e25 m/s2"}}, Overrides{{"release.height", "1e160 m"}}}) {
    const std::string what = numerics_failure("runaway", change);
    EXPECT_THAT(what, testing::HasSubstr("The flow has become so fast that its stable step of "));
    EXPECT_THAT(what, testing::HasSubstr(" at t = 0 s (step 0)"));
    EXPECT_THAT(what, testing::HasSubstr(" at x = "));
  }
}

TEST(Endings, AMissingWorkerIsAnEngineError) {
  RunOptions options = options_in(fresh_folder("missing"));
  options.workers = "/nonexistent";
  EXPECT_THROW(watch(small_scene("grains", {{"grains.seed", "20023"}}), options), EngineError);
}

}  // namespace
}  // namespace couloir
