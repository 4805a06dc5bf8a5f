#pragma once
// Runs tests/scenes/small_wall.yaml and keeps all that the observers are told.

#include <gtest/gtest.h>

#include <filesystem>

#include "coupling/loop/run.hpp"
#include "coupling/scene/reader.hpp"

namespace couloir {

struct Watched : Observer {
  std::vector<WindowReport> windows;
  std::vector<Event> events;
  std::vector<Resumption> resumed;
  std::vector<std::vector<double>> frames;  // depth, then grain positions and velocities
  RunEnd end;
  bool finished = false;
  void on_window(const WindowReport& w) override { windows.push_back(w); }
  void on_event(const Event& e) override { events.push_back(e); }
  void on_frame(const FrameView& f) override {
    std::vector<double> all;
    if (f.h)
      for (const auto* field : {f.h, f.hu, f.hv}) all.insert(all.end(), field->begin(), field->end());
    if (f.grains)
      for (const auto* field : {&f.grains->x, &f.grains->y, &f.grains->z, &f.grains->vx, &f.grains->vy, &f.grains->vz})
        all.insert(all.end(), field->begin(), field->end());
    frames.push_back(all);
  }
  void on_resume(const Resumption& r) override { resumed.push_back(r); }
  void state(Archive& a) override {  // as a recorder: what came since the checkpoint is taken back
    std::size_t count[] = {windows.size(), events.size(), frames.size()};
    a(count);
    windows.resize(count[0]), events.resize(count[1]), frames.resize(count[2]);
  }
  void on_finish(const RunEnd& e) override {
    end = e;
    finished = true;
  }
};

// The process's own folder in the build tree, gone when it ends.
struct TestRuns {
  std::filesystem::path path = std::filesystem::path(COULOIR_BINARY_DIR) / "test_runs" / std::to_string(getpid());
  ~TestRuns() { std::filesystem::remove_all(path); }
};

inline std::string fresh_folder(const std::string& name) {
  static const TestRuns test_runs;
  const auto path = test_runs.path / name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path.string();
}

inline RunOptions options_in(const std::string& folder) {
  RunOptions options;
  options.work_dir = folder;
  options.workers = COULOIR_BINARY_DIR "/bin";
  options.packings = COULOIR_BINARY_DIR "/test_packings";
  std::filesystem::create_directories(options.packings);
  return options;
}

inline Scene small_scene(const std::string& mode, Overrides more = {}) {
  more.insert(more.begin(), {"mode", mode});
  return read_scene(COULOIR_SOURCE_DIR "/tests/scenes/small_wall.yaml", COULOIR_SOURCE_DIR "/dem_inputs/materials", more);
}

inline Watched watch(const Scene& scene, const RunOptions& options) {
  Watched watched;
  run_scene(scene, options, {&watched});
  return watched;
}

}  // namespace couloir
