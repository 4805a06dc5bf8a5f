// The disk is full, or a limit is reached: a sentence, not a crash; and the file as far as it was flushed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "coupling/records/forces_csv.hpp"
#include "coupling/records/reader.hpp"
#include "coupling/records/record_error.hpp"
#include "coupling/records/records.hpp"
#include "coupling/records/summary.hpp"
#include "synthetic_run.hpp"

namespace couloir::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

template <class F>
std::string record_error(F&& run) {
  try {
    run();
  } catch (const RecordError& e) {
    return e.what();
  }
  return "";
}

TEST(Failure, FullDiskUnderTheForces) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "forces.csv");
  ForcesCsv csv(folder / "forces.csv");
  const SyntheticRun run(Mode::continuum);
  EXPECT_EQ(record_error([&] { run.play({&csv}); }),
            (folder / "forces.csv") + " could not be written: No space left on device; free space there or choose another --out");
  EXPECT_NO_THROW(csv.on_window(run.window(0)));
  EXPECT_NO_THROW(csv.on_finish({})) << "the end of a failed run must still reach the other observers";
}

TEST(Failure, FolderGoneUnderTheSummary) {
  const TemporaryFolder folder;
  Summary summary(folder / "gone/summary.json");
  EXPECT_THAT(record_error([&] { SyntheticRun(Mode::continuum).play({&summary}); }),
              AllOf(HasSubstr("gone/summary.json"), HasSubstr("No such file or directory")));
}

TEST(Failure, RecordsWhereNothingCanBeMade) {
  EXPECT_THAT(record_error([] { Records records("/proc/records.h5", ""); }),
              AllOf(StartsWith("/proc/records.h5 could not be written: "), HasSubstr("No such file or directory")));
}

// In a process of its own, which may write files of at most 200 kB.
TEST(Failure, FullDiskUnderTheRecords) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{200000, 200000};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::string told, at_end;
    {
      Records records(folder / "records.h5", "scene");
      const SyntheticRun run(Mode::coupled);
      told = record_error([&] { run.play({&records}); });
      at_end = record_error([&] { records.on_finish({}); });
    }
    std::ofstream(folder / "told.txt") << told << "|" << at_end;
    exit(0);
  }
  int state = 0;
  waitpid(child, &state, 0);
  ASSERT_TRUE(WIFEXITED(state));
  EXPECT_EQ(WEXITSTATUS(state), 0);
  std::string told;
  std::ifstream in(folder / "told.txt");
  std::getline(in, told);
  EXPECT_EQ(told, (folder / "records.h5") + " could not be written: File too large; free space there or choose another --out|");
  EXPECT_GE(RecordsReader(folder / "records.h5").frames().size(), 1u);
}

TEST(Failure, ForeignFileIsNoRecord) {
  const TemporaryFolder folder;
  std::ofstream(folder / "records.h5") << "no HDF5 at all";
  EXPECT_THAT(record_error([&] { RecordsReader reader(folder / "records.h5"); }), HasSubstr("could not be opened"));
}

}  // namespace
}  // namespace couloir::testing
