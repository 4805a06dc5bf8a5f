#include "coupling/records/forces_csv.hpp"

#include <fmt/core.h>

namespace couloir {

ForcesCsv::ForcesCsv(const std::string& path, bool resumed) : path_(path) {
  if (!resumed) file_.emplace(path);
}

void ForcesCsv::state(Archive& a) {
  std::int64_t length = a.loading() ? 0 : file_->settled();
  a(length, time_, since_, impulse_, measured_, stressed_, together_);
  if (a.loading()) file_.emplace(TextFile::reopened(path_, length));
}

void ForcesCsv::on_start(const RunStart& start) {
  interval_ = start.scene->record.forces;
  impulse_.assign(start.obstacles.size(), Vec{});
  measured_.assign(start.measures.size(), {});
  stressed_.assign(start.stress_gauges.size(), {});
  together_ = {};
  if (start.resumed) return;
  std::string header = "time [s]";
  for (const std::string& name : start.obstacles) header += fmt::format(",{0} x [N],{0} y [N],{0} z [N]", name);
  for (const ForceMeasure& m : start.measures) header += fmt::format(",{0} {1} x [N],{0} {1} y [N]", m.of, m.kind);
  for (const StressGauge& g : start.stress_gauges)
    header += fmt::format(",{0} {1} normal [Pa],{0} {1} up [Pa],{0} {1} across [Pa]", g.of, g.name);
  if (!start.obstacles.empty()) header += ",together x [N],together by control volume x [N]";
  file_->line(header);
}

void ForcesCsv::on_window(const WindowReport& window) {
  time_ = window.time;
  since_ += window.length;
  for (std::size_t k = 0; k < impulse_.size() && k < window.obstacles.size(); ++k)
    for (int c = 0; c < 3; ++c) impulse_[k][c] += window.obstacles[k].force[c] * window.length;
  for (std::size_t k = 0; k < measured_.size() && k < window.measures.size(); ++k)
    for (int c : {0, 1}) measured_[k][c] += window.measures[k][c] * window.length;
  for (std::size_t k = 0; k < stressed_.size() && k < window.stresses.size(); ++k) {
    const GaugeStress& s = window.stresses[k];
    stressed_[k].normal += s.normal * window.length;
    stressed_[k].up += s.up * window.length;
    stressed_[k].across += s.across * window.length;
  }
  together_[0] += window.momentum.to_obstacles();
  together_[1] += window.momentum.lost_to_obstacles();
  // A hair of slack: windows of 0.25 ms must make rows of 1 ms in spite of round-off.
  if (since_ >= interval_ * (1 - 1e-9)) write_row();
}

void ForcesCsv::on_finish(const RunEnd&) {
  if (file_ && since_ > 0) write_row();
}

void ForcesCsv::write_row() {
  if (since_ <= 0) return;
  std::string row = fmt::format("{:.9g}", time_);
  for (Vec& impulse : impulse_) {
    for (const double component : impulse) row += fmt::format(",{:.9g}", component / since_);
    impulse = Vec{};
  }
  for (auto& impulse : measured_) {
    for (const double component : impulse) row += fmt::format(",{:.9g}", component / since_);
    impulse = {};
  }
  for (GaugeStress& impulse : stressed_) {
    for (const double component : {impulse.normal, impulse.up, impulse.across}) row += fmt::format(",{:.9g}", component / since_);
    impulse = {};
  }
  if (!impulse_.empty()) row += fmt::format(",{:.9g},{:.9g}", together_[0] / since_, together_[1] / since_);
  together_ = {};
  since_ = 0;
  file_->line(row);
}

}  // namespace couloir
