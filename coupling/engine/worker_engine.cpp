#include "coupling/engine/worker_engine.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <random>
#include <zmq.hpp>

#include "coupling/engine/engine_error.hpp"
#include "coupling/engine/protocol.hpp"
#include "coupling/engine/worker_process.hpp"

namespace couloir {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto slice = std::chrono::milliseconds(50);  // how soon a dead worker is noticed
constexpr double time_to_end = 2;                      // [s] that a worker asked to stop gets
constexpr double time_to_load = 60;                    // [s] that it gets at least to load its engine

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

// An abstract socket: no file, no limit by the length of a path, gone with the process.
std::string fresh_endpoint() {
  static int count = 0;
  std::random_device random;
  return fmt::format("ipc://@couloir-{}-{}-{:08x}", getpid(), ++count, random());
}

std::string tail(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::deque<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
    if (lines.size() > 15) lines.pop_front();
  }
  if (lines.empty()) return {};
  std::string text = fmt::format("\n--- end of {}", file.string());
  for (const std::string& line : lines) text += "\n" + line;
  return text;
}

}  // namespace

struct WorkerEngine::Run {
  zmq::context_t context{1};
  zmq::socket_t socket{context, zmq::socket_type::pair};
  std::unique_ptr<WorkerProcess> process;
  std::filesystem::path work_dir;
  double timeout = 0;
  int pid = 0;  // of the first rank

  bool receive(std::string& message, std::chrono::milliseconds patience) {
    zmq::pollitem_t item{socket.handle(), 0, ZMQ_POLLIN, 0};
    try {
      if (zmq::poll(&item, 1, patience) == 0) return false;
    } catch (const zmq::error_t& e) {
      if (e.num() == EINTR) return false;  // Ctrl-C is the caller's business
      throw;
    }
    zmq::message_t raw;
    if (!socket.recv(raw, zmq::recv_flags::dontwait)) return false;
    message = raw.to_string();
    return true;
  }
};

std::string default_worker_folder() {
  if (const char* folder = std::getenv("COULOIR_WORKER_DIR"); folder && *folder) return folder;
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "." : self.parent_path().string();
}

std::string worker_path(const std::string& engine, const std::string& folder) {
  return fmt::format("{}/couloir_{}_worker", folder, engine);
}

WorkerEngine::WorkerEngine(std::string worker_path) : worker_path_(std::move(worker_path)) {}
WorkerEngine::~WorkerEngine() {
  stop();
}

std::string WorkerEngine::name() const {
  return name_;
}
int WorkerEngine::worker_pid() const {
  return run_ ? run_->pid : 0;
}

void WorkerEngine::start(const EngineSetup& setup) {
  open(setup, "");
}

void WorkerEngine::restore(const EngineSetup& setup, const std::string& path) {
  if (!std::filesystem::exists(path)) throw EngineError(fmt::format("the grain engine's checkpoint {} does not exist", path));
  open(setup, path);
}

void WorkerEngine::open(const EngineSetup& setup, const std::string& checkpoint) {
  if (run_) throw EngineError("the grain engine is running already; stop it first");
  if (!std::filesystem::is_directory(setup.work_dir)) {
    throw EngineError(fmt::format("the grain engine's work folder '{}' does not exist", setup.work_dir));
  }
  protocol::Start start{setup, checkpoint.empty() ? "" : std::filesystem::absolute(checkpoint).string()};
  start.setup.work_dir = std::filesystem::absolute(setup.work_dir).string();
  run_ = std::make_unique<Run>();
  run_->work_dir = start.setup.work_dir;
  try {
    std::error_code error;
    std::filesystem::remove(run_->work_dir / "engine.log", error);
    const std::string endpoint = fresh_endpoint();
    run_->socket.set(zmq::sockopt::linger, 0);
    run_->socket.bind(endpoint);
    run_->process = std::make_unique<WorkerProcess>(worker_path_, std::vector<std::string>{endpoint}, setup.ranks,
                                                    (run_->work_dir / "worker.log").string());
    protocol::Hello hello;
    run_->timeout = std::max(setup.timeout, time_to_load);
    protocol::decode(ask(""), hello);
    run_->pid = hello.pid;
    protocol::Started started;
    protocol::decode(ask(protocol::encode(start)), started);
    name_ = started.engine;
    run_->timeout = setup.timeout;
  } catch (const zmq::error_t& e) {
    stop();
    throw EngineError(fmt::format("the connection to the grain engine's worker failed: {}", e.what()));
  } catch (...) {
    stop();
    throw;
  }
}

template <class Error>
void WorkerEngine::fail(const std::string& reason) {
  const std::filesystem::path folder = run_->work_dir;
  run_.reset();  // kills
  throw Error(reason + tail(folder / "engine.log") + tail(folder / "worker.log"));
}

// Sends a command (an empty one only listens) and waits for its answer. Throws where the worker dies, is silent, or fails.
std::string WorkerEngine::ask(const std::string& message) {
  if (!run_) throw EngineError("the grain engine is not running: it was not started, was stopped, or failed before");
  try {
    if (!message.empty()) run_->socket.send(zmq::buffer(message), zmq::send_flags::dontwait);
    Clock::time_point heard = Clock::now();
    std::string answer;
    for (;;) {
      const bool alive = run_->process->running();  // before we listen: its last words come first
      if (run_->receive(answer, slice)) {
        heard = Clock::now();
        const protocol::Kind kind = protocol::kind_of(answer);
        if (kind == protocol::Kind::heartbeat) continue;
        if (kind != protocol::Kind::failed) return answer;
        protocol::Failed failed;
        protocol::decode(answer, failed);
        const std::string said = fmt::format("the grain engine reports: {}", failed.reason);
        if (failed.runaway) fail<RunawayError>(said);
        fail<EngineReport>(said);
      }
      if (!alive) {
        fail(fmt::format("the grain engine's worker (pid {}) {}", run_->pid ? run_->pid : run_->process->pid(),
                         run_->process->how_it_ended()));
      }
      if (seconds_since(heard) > run_->timeout) {
        fail(fmt::format(
            "the grain engine's worker (pid {}) has not answered for {:g} s and was stopped; a longer limit is set by "
            "grains.timeout",
            run_->pid ? run_->pid : run_->process->pid(), run_->timeout));
      }
    }
  } catch (const zmq::error_t& e) {
    fail(fmt::format("the connection to the grain engine's worker failed: {}", e.what()));
  }
}

Advanced WorkerEngine::advance(const AdvanceRequest& request) {
  const std::string answer = ask(protocol::encode(request));
  Advanced result;
  try {
    protocol::decode(answer, result);
  } catch (...) {
    stop();
    throw;
  }
  return result;
}

void WorkerEngine::checkpoint(const std::string& path) {
  const std::string answer = ask(protocol::encode(protocol::Checkpoint{std::filesystem::absolute(path).string()}));
  if (const protocol::Kind kind = protocol::kind_of(answer); kind != protocol::Kind::done) {
    fail(fmt::format("the grain engine's worker answered a checkpoint with '{}'", protocol::to_string(kind)));
  }
}

void WorkerEngine::stop() {
  if (!run_) return;
  try {
    if (run_->process && run_->process->running()) {
      run_->socket.send(zmq::buffer(protocol::encode(protocol::Kind::stop)), zmq::send_flags::dontwait);
      run_->process->wait(time_to_end);
    }
  } catch (...) {  // what does not stop by itself is killed below
  }
  run_.reset();
}

}  // namespace couloir
