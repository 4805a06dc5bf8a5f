#pragma once
// RUN/forces.csv: time and the force on each obstacle, for those who want no HDF5.
#include <optional>
#include <string>
#include <vector>

#include "coupling/loop/observer.hpp"
#include "coupling/records/text_file.hpp"

namespace couloir {

// Rows are at least scene.record.forces apart. A row holds the mean since the row before, so no impulse is lost by thinning:
// the sum of force times (time - time of the row before) is the impulse [N s].
//
//   time [s],wall x [N],wall y [N],wall z [N]      x along the slope, y across it, z along the normal
//
// then x and y of every other measure of force: wall control_volume x [N],...,downstream wall x [N],downstream wall y [N], and
// the stresses on each gauge: wall middle normal [Pa],wall middle up [Pa],wall middle across [Pa]; and last, where there are
// obstacles, the force on all of them by their own forces and by what the material lost (docs/forces.md):
// together x [N],together by control volume x [N]
class ForcesCsv : public Observer {
 public:
  // Throws RecordError. `resumed`: state() will open the file of an earlier process.
  explicit ForcesCsv(const std::string& path, bool resumed = false);
  void on_start(const RunStart&) override;
  void on_window(const WindowReport&) override;
  void on_finish(const RunEnd&) override;
  void state(Archive&) override;

 private:
  void write_row();

  std::string path_;
  std::optional<TextFile> file_;
  double interval_ = 0;                          // [s]
  double time_ = 0, since_ = 0;                  // [s] now; covered by impulse_
  std::vector<Vec> impulse_;                     // [N s] since the last row
  std::vector<std::array<double, 2>> measured_;  // the same by the other measures
  std::vector<GaugeStress> stressed_;            // [Pa s]
  std::array<double, 2> together_{};             // [N s] own, by the control volume
};

}  // namespace couloir
