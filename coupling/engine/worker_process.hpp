#pragma once
// A child process in its own process group that cannot outlive us.

#include <sys/types.h>

#include <string>
#include <vector>

namespace couloir {

// Runs `program arguments...`, for ranks > 1 under mpirun; its standard output and error go to the file `log`.
// The child gets no Ctrl-C of ours (own process group), and dies when the thread that made it ends, however that ends.
class WorkerProcess {
 public:
  // Throws EngineError where the program is missing or cannot be run.
  WorkerProcess(const std::string& program, const std::vector<std::string>& arguments, int ranks, const std::string& log);
  ~WorkerProcess();  // kills
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  pid_t pid() const { return pid_; }  // of the program, or of mpirun
  bool running();                     // asks the system; false once it has ended
  bool wait(double seconds);          // true if it ended within that time
  void kill();                        // SIGKILL to the whole group; returns when it is gone
  std::string how_it_ended() const;   // "was killed by signal 9 (Killed)", "ended with exit code 3"

 private:
  void note(int status);
  pid_t pid_ = 0;
  bool running_ = false;
  int signal_ = 0, code_ = 0;
};

}  // namespace couloir
