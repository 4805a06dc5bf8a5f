// Runs that do not end by themselves: observers hear of it, and the state is on disk.

#include <gmock/gmock.h>

#include <csignal>

#include "continuum/errors.hpp"
#include "coupling/checkpoint/checkpoint_folder.hpp"
#include "coupling/engine/engine_error.hpp"
#include "small_run.hpp"

namespace couloir {
namespace {

RunOptions with_checkpoints(const std::string& folder) {
  RunOptions options = options_in(folder);
  options.checkpoints = folder + "/checkpoint";
  return options;
}

std::vector<double> forces(const Watched& run) {
  std::vector<double> all;
  for (const WindowReport& w : run.windows) all.push_back(w.obstacles[0].force[0]);
  return all;
}

// Kills the worker, once it has gone so far, as often as asked.
struct Killer : Observer {
  int times;
  double after;  // [s]
  int pid = 0;
  Killer(int n, double t) : times(n), after(t) {}
  void on_window(const WindowReport& w) override {
    if (times > 0 && w.time > after && w.grains > 0) --times, ::kill(pid, SIGKILL);
  }
};

TEST(Endings, AKilledWorkerIsStartedAgainAndTheRunIsTheSame) {
  const Scene scene = small_scene("coupled", {{"duration", "0.12 s"}, {"record.checkpoint", "6 ms"}});
  const Watched whole = watch(scene, with_checkpoints(fresh_folder("whole")));
  RunOptions options = with_checkpoints(fresh_folder("killed"));
  Killer killer(1, 0.1);
  options.on_engine = [&](const GrainEngine& engine) { killer.pid = engine.worker_pid(); };
  Watched watched;
  const RunEnd end = run_scene(scene, options, {&watched, &killer});
  EXPECT_EQ(end.status, "done");
  EXPECT_EQ(killer.times, 0);
  ASSERT_EQ(watched.resumed.size(), 1u);
  EXPECT_NE(watched.resumed[0].reason.find("signal 9"), std::string::npos) << watched.resumed[0].reason;
  EXPECT_GT(watched.resumed[0].time, 0.09);
  EXPECT_EQ(forces(watched), forces(whole));
  EXPECT_EQ(watched.frames, whole.frames);
}

TEST(Endings, AWorkerThatIsKilledAgainEndsTheRunWithItsStateSaved) {
  const std::string folder = fresh_folder("killed_again");
  RunOptions options = with_checkpoints(folder);
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
  EXPECT_EQ(watched.resumed.size(), 1u);
  EXPECT_FALSE(watched.windows.empty()) << "what came before is told";
  EXPECT_EQ(CheckpointFolder::read(options.checkpoints).time, watched.end.checkpoint);
}

TEST(Endings, AnInterruptEndsTheRunWithItsStateSaved) {
  RunOptions options = with_checkpoints(fresh_folder("interrupted"));
  int asked = 0;
  options.interrupted = [&] { return ++asked > 100; };
  const Watched run = watch(small_scene("coupled"), options);
  EXPECT_EQ(run.end.status, "interrupted");
  EXPECT_EQ(run.windows.size(), 101u);
  EXPECT_GT(run.end.checkpoint, run.windows.back().time - 0.25 / 20);
}

// What the run says when the numbers leave the solver's range, and that the state is kept.
std::string numerics_failure(const std::string& name, const Overrides& change) {
  const std::string folder = fresh_folder(name);
  Watched watched;
  try {
    run_scene(small_scene("continuum", change), with_checkpoints(folder), {&watched});
  } catch (const NumericsError& error) {
    EXPECT_TRUE(watched.finished);
    EXPECT_EQ(watched.end.status, "failed");
    EXPECT_EQ(watched.end.reason, error.what());
    EXPECT_EQ(CheckpointFolder::read(folder + "/checkpoint").time, 0);
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
