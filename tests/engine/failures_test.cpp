// What the user reads when the engine fails.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;
using testing::AllOf;
using testing::HasSubstr;

namespace {

void start_with_grains(WorkerEngine& engine, const EngineSetup& setup) {
  engine.start(setup);
  AdvanceRequest request = steps(10);
  request.insert = lattice(8, 6);
  engine.advance(request);
}

}  // namespace

struct Failures : OnEngine {};

INSTANTIATE_TEST_SUITE_P(On, Failures, engines, name_of_engine);

TEST_P(Failures, TheEnginesOwnWordsReachTheUser) {
  Folder folder;
  EngineSetup setup = box(folder.path);
  setup.youngs_modulus = 1e3;
  setup.surfaces[2].rolling_friction = 0.05;
  WorkerEngine engine(worker());
  EXPECT_THAT(error_of([&] { engine.start(setup); }),
              AllOf(HasSubstr("the grain engine reports:"),
                    HasSubstr(yade() ? "YADE takes one rolling friction for all surfaces: 'floor' has 0.15 and 'x1' 0.05"
                                     : "youngsModulus >= 5e6"),
                    HasSubstr("--- end of")));
  EXPECT_EQ(engine.worker_pid(), 0);
}

TEST_P(Failures, WorkerKilledBetweenAdvances) {
  Folder folder;
  WorkerEngine engine(worker());
  start_with_grains(engine, box(folder.path));
  const int pid = engine.worker_pid();
  ASSERT_GT(pid, 0);
  kill(pid, SIGKILL);
  EXPECT_THAT(error_of([&] { engine.advance(steps(10)); }),
              AllOf(HasSubstr("the grain engine's worker (pid " + std::to_string(pid) + ") was killed by signal 9 (Killed)"),
                    HasSubstr("engine.log")));
  engine.stop();
  engine.stop();
}

TEST_P(Failures, WorkerKilledDuringAnAdvance) {
  for (const int ranks : OnEngine::ranks()) {
    Folder folder;
    WorkerEngine engine(worker());
    EngineSetup setup = box(folder.path);
    setup.ranks = ranks;
    start_with_grains(engine, setup);
    const int pid = engine.worker_pid();
    std::thread killer([pid] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      kill(pid, SIGKILL);
    });
    EXPECT_THAT(error_of([&] { engine.advance(steps(10'000'000)); }), HasSubstr("was killed by signal 9"));
    killer.join();
    EXPECT_EQ(engine.worker_pid(), 0);
  }
}

TEST_P(Failures, AStoppedWorkerTimesOut) {
  Folder folder;
  WorkerEngine engine(worker());
  EngineSetup setup = box(folder.path);
  setup.timeout = 2;
  start_with_grains(engine, setup);
  const int pid = engine.worker_pid();
  kill(pid, SIGSTOP);
  EXPECT_THAT(error_of([&] { engine.advance(steps(10)); }), HasSubstr("has not answered for 2 s"));
  EXPECT_NE(kill(pid, 0), 0) << "the worker is still there";
}

TEST_P(Failures, ALongAdvanceIsNoHang) {
  Folder folder;
  WorkerEngine engine(worker());
  EngineSetup setup = box(folder.path);
  setup.timeout = 60;
  start_with_grains(engine, setup);
  const auto begin = std::chrono::steady_clock::now();
  engine.advance(steps(2000));
  const double rate = 2000 / std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  engine.stop();
  setup.timeout = 3;
  start_with_grains(engine, setup);
  EXPECT_NO_THROW(engine.advance(steps(static_cast<std::int64_t>(6 * rate))));
}

TEST_P(Failures, MissingWorkerAndMissingFolder) {
  Folder folder;
  WorkerEngine engine("/nowhere/couloir_liggghts_worker");
  EXPECT_THAT(error_of([&] { engine.start(box(folder.path)); }),
              AllOf(HasSubstr("/nowhere/couloir_liggghts_worker cannot be run: No such file"), HasSubstr("COULOIR_WORKER_DIR")));
  WorkerEngine other(worker());
  EXPECT_THAT(error_of([&] { other.start(box("/nowhere/at/all")); }), HasSubstr("work folder '/nowhere/at/all' does not exist"));
}

TEST_P(Failures, AProgramThatIsNoWorkerIsNoticed) {
  Folder folder;
  WorkerEngine engine("/bin/false");
  EXPECT_THAT(error_of([&] { engine.start(box(folder.path)); }), HasSubstr("ended with exit code 1"));
}

TEST_P(Failures, NoWorkerOutlivesItsProgram) {
  Folder folder;
  int report[2];
  ASSERT_EQ(pipe(report), 0);
  const pid_t program = fork();
  if (program == 0) {
    WorkerEngine engine(worker());
    engine.start(box(folder.path));
    const int pid = engine.worker_pid();
    if (write(report[1], &pid, sizeof pid) != sizeof pid) _exit(1);
    raise(SIGKILL);
  }
  close(report[1]);
  int pid = 0;
  ASSERT_EQ(read(report[0], &pid, sizeof pid), static_cast<ssize_t>(sizeof pid));
  close(report[0]);
  waitpid(program, nullptr, 0);
  // An orphan that nobody collects stays as a zombie: it is dead where its command line is empty.
  const auto alive = [pid] {
    std::ifstream file("/proc/" + std::to_string(pid) + "/cmdline");
    return file.peek() != std::ifstream::traits_type::eof();
  };
  for (int i = 0; i < 200 && alive(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(alive());
}
