#include "coupling/engine/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>
#include <thread>

#include "coupling/engine/engine_error.hpp"

extern char** environ;

namespace couloir {

namespace {

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> list;
  for (std::string& s : strings) list.push_back(s.data());
  list.push_back(nullptr);
  return list;
}

std::vector<std::string> command_line(const std::string& program, const std::vector<std::string>& arguments, int ranks) {
  std::vector<std::string> words;
  if (ranks > 1) {
    // Ranks give way while they wait: there may be fewer cores than ranks and threads of ours.
    words = {"mpirun",
             "-n",
             std::to_string(ranks),
             "--oversubscribe",
             "--allow-run-as-root",
             "--bind-to",
             "none",
             "--mca",
             "mpi_yield_when_idle",
             "1"};
  }
  words.push_back(program);
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

// MPI in this process, where the mesh is refined, says here that the process is on its own: mpirun and its ranks must not hear
// it.
bool is_of_our_mpi(std::string_view variable) {
  for (const char* name : {"OMPI_MCA_ess=", "OMPI_MCA_orte_", "OMPI_MCA_pmix=", "OMPI_APP_CTX_", "ORTE_", "PMIX_"})
    if (variable.starts_with(name)) return true;
  return false;
}

std::vector<std::string> environment() {
  std::vector<std::string> list;
  for (char** e = environ; *e; ++e)
    if (!is_of_our_mpi(*e)) list.emplace_back(*e);
  list.emplace_back("OMPI_ALLOW_RUN_AS_ROOT=1");
  list.emplace_back("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1");
  list.emplace_back("OMPI_MCA_ess_singleton_isolated=1");              // one rank needs no daemon beside it
  list.emplace_back("OMPI_MCA_btl_vader_single_copy_mechanism=none");  // not permitted in containers, and then noisy
  return list;
}

}  // namespace

WorkerProcess::WorkerProcess(const std::string& program, const std::vector<std::string>& arguments, int ranks,
                             const std::string& log) {
  if (access(program.c_str(), X_OK) != 0) {
    throw EngineError(
        fmt::format("the grain engine's worker {} cannot be run: {}; build it, or name its folder in COULOIR_WORKER_DIR", program,
                    std::strerror(errno)));
  }
  std::vector<std::string> words = command_line(program, arguments, ranks), settings = environment();
  const std::vector<char*> argv = pointers(words), envp = pointers(settings);
  const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (out < 0) throw EngineError(fmt::format("the grain engine's log {} cannot be written: {}", log, std::strerror(errno)));
  const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
  int report[2];  // carries errno of a failed exec, or closes when it succeeds
  if (in < 0 || pipe2(report, O_CLOEXEC) != 0) {
    close(out);
    if (in >= 0) close(in);
    throw EngineError(fmt::format("the grain engine's worker cannot be started: {}", std::strerror(errno)));
  }

  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {  // only async-signal-safe calls from here to exec
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);
    signal(SIGINT, SIG_IGN);
    dup2(in, 0);
    dup2(out, 1);
    dup2(out, 2);
    execvpe(argv[0], argv.data(), envp.data());
    const int error = errno;
    if (write(report[1], &error, sizeof error) < 0) _exit(126);
    _exit(127);
  }
  const int fork_error = errno;
  close(in);
  close(out);
  close(report[1]);
  int error = pid_ < 0 ? fork_error : 0;
  if (pid_ > 0) {
    running_ = true;
    ssize_t got;
    while ((got = read(report[0], &error, sizeof error)) < 0 && errno == EINTR) {
    }
    if (got != sizeof error) error = 0;
  }
  close(report[0]);
  if (error) {
    kill();
    throw EngineError(fmt::format("the grain engine's worker {} cannot be started: {}", words[0], std::strerror(error)));
  }
}

WorkerProcess::~WorkerProcess() {
  kill();
}

void WorkerProcess::note(int status) {
  running_ = false;
  if (WIFSIGNALED(status)) signal_ = WTERMSIG(status);
  if (WIFEXITED(status)) code_ = WEXITSTATUS(status);
  if (code_ > 128 && code_ < 128 + 65) signal_ = code_ - 128;  // as mpirun and shells pass on a rank's death
}

bool WorkerProcess::running() {
  int status = 0;
  if (running_ && waitpid(pid_, &status, WNOHANG) == pid_) note(status);
  return running_;
}

bool WorkerProcess::wait(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (running()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

void WorkerProcess::kill() {
  if (!running()) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);  // it may not have reached setpgid
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  note(status);
}

std::string WorkerProcess::how_it_ended() const {
  if (signal_) return fmt::format("was killed by signal {} ({})", signal_, strsignal(signal_));
  return fmt::format("ended with exit code {}", code_);
}

}  // namespace couloir
