#pragma once
// Progress for the one who waits: simulated time, step, cells, grains, rate, time left.
//
// On a terminal one line that overwrites itself; otherwise a plain line every 10 % or 5 s, whichever is longer apart. Events are
// lines of their own. log.txt gets every event and the plain lines, whatever the screen shows.

#include <chrono>
#include <cstdio>
#include <string>

#include "coupling/loop/observer.hpp"
#include "coupling/records/text_file.hpp"

namespace couloir {

struct ConsoleSettings {
  std::FILE* out = stderr;
  bool terminal = false;  // isatty of `out`, asked by the caller
  bool quiet = false;     // --json: nothing on the screen, the log alone
};

class Console : public Observer {
 public:
  Console(const std::string& log_path, const ConsoleSettings&, bool append_log = false);
  void on_start(const RunStart&) override;
  void on_window(const WindowReport&) override;
  void on_event(const Event&) override;
  void on_resume(const Resumption&) override;
  void on_finish(const RunEnd&) override;

 private:
  using Clock = std::chrono::steady_clock;
  std::string progress(const WindowReport&) const;
  void show(const std::string& line);       // a line that stays
  void overwrite(const std::string& line);  // the terminal's last line
  double seconds(Clock::time_point since) const { return std::chrono::duration<double>(Clock::now() - since).count(); }

  ConsoleSettings settings_;
  TextFile log_;
  Clock::time_point begin_, shown_, measured_;
  double duration_ = 0, begin_time_ = -1, measured_time_ = 0, logged_share_ = 0;
  double rate_ = 0;  // simulated over wall seconds, of late
  long cells_ = 0;
  std::size_t width_ = 0;  // of what stands on the terminal's last line
};

// "1 h 02 min", "3 min 20 s", "12 s".
std::string in_words(double seconds);

}  // namespace couloir
