#pragma once
// A run with all that records it, in a folder, broken off and gone on with at will; and what a folder holds.

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "coupling/loop/run.hpp"
#include "coupling/records/compare.hpp"
#include "coupling/records/forces_csv.hpp"
#include "coupling/records/reader.hpp"
#include "coupling/records/records.hpp"
#include "coupling/records/summary.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/records/xdmf.hpp"
#include "tests/loop/small_run.hpp"

namespace couloir {

// Counts windows, and tells to stop after so many.
struct Stopper : Observer {
  long left;
  explicit Stopper(long windows) : left(windows) {}
  void on_window(const WindowReport&) override { --left; }
};

struct RecordedRun {
  std::string folder;
  Scene scene;
  RunOptions options;

  RecordedRun(const std::string& name, const Scene& of) : folder(fresh_folder(name)), scene(of), options(options_in(folder)) {
    options.checkpoints = folder + "/checkpoint";
    options.made_by = "this program";
  }

  // Until the end, or an interrupt after so many windows; `resume`: from the last checkpoint.
  RunEnd go(bool resume, long windows = 1L << 60) {
    RunOptions how = options;
    how.resume = resume;
    Stopper stopper(windows);
    how.interrupted = [&] { return stopper.left <= 0; };
    Records records(folder + "/records.h5", "scene", options.checkpoints, resume);
    Xdmf xdmf(folder);
    ForcesCsv forces(folder + "/forces.csv", resume);
    Summary summary(folder + "/summary.json");
    return run_scene(scene, how, {&stopper, &records, &xdmf, &forces, &summary});
  }

  nlohmann::json figures() const {
    nlohmann::json all = nlohmann::json::parse(read_text(folder + "/summary.json"));
    all["time"] = all["time"]["simulated"];
    all["continuum"].erase("cell_updates_per_second");
    all["grains"].erase("particle_steps_per_second");
    all.erase("resumed");
    all.erase("costs");
    return all;
  }
};

inline void expect_same(const RecordedRun& a, const RecordedRun& b) {
  EXPECT_EQ(first_difference(RecordsReader(a.folder + "/records.h5"), RecordsReader(b.folder + "/records.h5")), "");
  for (const char* name : {"/forces.csv", "/flow.xdmf", "/grains.xdmf"}) {
    ASSERT_EQ(std::filesystem::exists(a.folder + name), std::filesystem::exists(b.folder + name)) << name;
    if (!std::filesystem::exists(a.folder + name)) continue;
    EXPECT_EQ(read_text(a.folder + name), read_text(b.folder + name)) << name;
  }
  EXPECT_EQ(a.figures(), b.figures());
}

}  // namespace couloir
