#pragma once
// A made-up run with known answers: a heap of depth 30 mm slides down a chute onto a wall, grains around the wall. No physics:
// each number is a formula, so that a test can say what must come back.

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/loop/observer.hpp"
#include "coupling/records/records.hpp"

namespace couloir::testing {

struct SyntheticRun {
  explicit SyntheticRun(Mode mode, double scale = 1);  // `scale` multiplies the forces

  // Tells the observers the whole run, or up to `until` and then, with `finish`, its end. With a `from` they go on from the
  // checkpoint that was made there.
  void play(const std::vector<Observer*>& observers, double from = 0, double until = 1e9, bool finish = true,
            const std::string& status = "done") const;

  RunStart start() const;
  WindowReport window(long k) const;  // ends at (k + 1) * length
  std::vector<double> depth(double time) const;
  BlocksView blocks(double time) const;  // the second one moves after 0.2 s
  Grains grains(double time) const;
  // Force along the slope on the wall in the window that ends at `time` [N]: 0 before 0.1 s, a sine bump of 20 ms and 40 N,
  // then 6 N; every fourth window carries 4 N more, every other fourth 4 N less, once there is contact.
  double force(double time) const;
  // Its samples in that window: a tone of 3 N (times scale) at the windows' frequency on top, once there is contact.
  std::vector<double> samples(double time) const;
  static constexpr int samples_of_window = 8;

  static constexpr double length = 0.001;  // [s] of a window
  static constexpr int windows = 400, frame_every = 40;

  Scene scene;
  ReferenceSurface surface;
  Grid grid;
  double scale;
  double checkpoint_at = -1;  // [s] where their states are saved; -1: nowhere
  mutable std::vector<std::uint8_t> saved;
  bool refined = false;   // two blocks of cells of half and a quarter of the size before the wall
  bool stresses = false;  // a gauge on the wall: normal, up and across 2, -0.5 and 0.1 times the force
  bool planes = false;    // the wall is made of planes: a heap that is deepest at 0.1 s, a climb that is highest at 0.12 s
};

// A folder that is gone when the test ends.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// Plays the run into `folder` with all recording observers.
void record(const SyntheticRun& run, const std::string& folder, const Started& started = {});

}  // namespace couloir::testing
