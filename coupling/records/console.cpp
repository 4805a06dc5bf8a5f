#include "coupling/records/console.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace couloir {
namespace {

constexpr double kRedraw = 0.2;      // [s] between overwrites
constexpr double kPlain = 5;         // [s] between plain lines, at least
constexpr double kPlainShare = 0.1;  // of the duration
constexpr double kMeasure = 1;       // [s] over which the rate is taken

}  // namespace

std::string in_words(double seconds) {
  const long s = std::lround(std::max(0.0, seconds));
  if (s >= 3600) return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
  if (s >= 60) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} s", s);
}

Console::Console(const std::string& log_path, const ConsoleSettings& settings, bool append_log)
    : settings_(settings), log_(log_path, append_log), begin_(Clock::now()), shown_(begin_), measured_(begin_) {}

void Console::on_start(const RunStart& start) {
  duration_ = start.scene->duration;
  cells_ = long(start.grid.nx) * start.grid.ny;
  begin_ = shown_ = measured_ = Clock::now();
  if (start.resumed) return;
  std::string on;
  for (const Effect& e : start.effects)
    if (e.on) on += (on.empty() ? "" : ", ") + e.name;
  show(fmt::format("{} ({} mode), {:.4g} s to simulate", start.scene->title.empty() ? start.scene->file : start.scene->title,
                   to_string(start.scene->mode), duration_));
  if (!on.empty()) show("simulated effects: " + on);
}

std::string Console::progress(const WindowReport& w) const {
  const double share = duration_ > 0 ? 100 * w.time / duration_ : 0;
  std::string line = fmt::format("t = {:.3f} s of {:.4g} s ({:.0f} %)", w.time, duration_, share);
  std::int64_t cells = w.levels.empty() ? cells_ : 0;
  for (const LevelCells& l : w.levels) cells += l.cells;
  if (cells > 0) line += fmt::format("  step {}  cells {}", w.solver_steps, cells);
  if (w.grains > 0) line += fmt::format("  grains {}", w.grains);
  if (rate_ > 0) {
    line += rate_ >= 0.1 ? fmt::format("  {:.2f} s/s", rate_) : fmt::format("  {:.1f} ms/s", 1e3 * rate_);
    line += fmt::format("  {} left", in_words((duration_ - w.time) / rate_));
  }
  return line;
}

void Console::on_window(const WindowReport& window) {
  if (begin_time_ < 0) begin_time_ = measured_time_ = window.time - window.length;
  if (const double wall = seconds(measured_); wall >= kMeasure || rate_ == 0) {
    // Grains come and go, and the cost of a simulated second with them: the newest second counts for a third.
    const double now = wall > 0 ? (window.time - measured_time_) / wall : 0;
    rate_ = rate_ > 0 && wall >= kMeasure ? rate_ + (now - rate_) / 3 : now;
    measured_ = Clock::now();
    measured_time_ = window.time;
  }
  const double share = duration_ > 0 ? window.time / duration_ : 0;
  const bool last = share >= 1 - 1e-9;
  const double since = seconds(shown_);
  if (settings_.terminal && !settings_.quiet && (since >= kRedraw || last)) {
    overwrite(progress(window));
    shown_ = Clock::now();
  }
  const bool due = share >= logged_share_ + kPlainShare && (settings_.terminal || settings_.quiet || since >= kPlain);
  if (!due && !(last && logged_share_ < 1)) return;
  logged_share_ = last ? 1 : share;
  const std::string line = progress(window);
  log_.line(line);
  if (settings_.terminal || settings_.quiet) return;
  std::fprintf(settings_.out, "%s\n", line.c_str());
  std::fflush(settings_.out);
  shown_ = Clock::now();
}

void Console::on_event(const Event& event) {
  show(fmt::format("{:.3f} s: {}", event.time, event.what));
}

void Console::on_resume(const Resumption& r) {
  begin_time_ = -1;
  rate_ = 0;
  logged_share_ = duration_ > 0 ? r.time / duration_ : 0;
  show(fmt::format("goes on from the checkpoint at t = {:.6g} s: {}", r.time, r.reason));
}

void Console::on_finish(const RunEnd& end) {
  std::string line = fmt::format("{} after {} ({} of processor time)", end.status, in_words(end.wall), in_words(end.cpu));
  if (!end.reason.empty()) line += ": " + end.reason;
  show(line);
}

void Console::show(const std::string& line) {
  if (!settings_.quiet) {
    if (settings_.terminal && width_ > 0) overwrite(""), std::fputc('\r', settings_.out), width_ = 0;
    std::fprintf(settings_.out, "%s\n", line.c_str());
    std::fflush(settings_.out);
  }
  log_.line(line);
}

void Console::overwrite(const std::string& line) {
  const std::size_t blank = width_ > line.size() ? width_ - line.size() : 0;
  std::fprintf(settings_.out, "\r%s%s", line.c_str(), std::string(blank, ' ').c_str());
  std::fflush(settings_.out);
  width_ = line.size();
}

}  // namespace couloir
