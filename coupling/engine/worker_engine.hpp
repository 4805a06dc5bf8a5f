#pragma once
// A grain engine behind the port, in a worker process of its own (coupling/workers).

#include <memory>
#include <string>

#include "coupling/engine/engine_error.hpp"
#include "coupling/engine/grain_engine.hpp"

namespace couloir {

// Where workers lie: the folder COULOIR_WORKER_DIR of the environment, else that of the running program.
std::string default_worker_folder();
// The worker of an engine: liggghts, yade.
std::string worker_path(const std::string& engine, const std::string& folder = default_worker_folder());

// See the port for the states. A stopped engine may be started again: it then is a new run in a new process.
// Writes engine.log (the engine's own log), worker.log (all else that the worker prints) and LIGGGHTS's surface_*.stl into the
// work folder.
// start and restore must be called from a thread that lives as long as the run: the worker dies with it.
class WorkerEngine final : public GrainEngine {
 public:
  explicit WorkerEngine(std::string worker_path);
  ~WorkerEngine() override;

  std::string name() const override;
  void start(const EngineSetup&) override;
  Advanced advance(const AdvanceRequest&) override;
  void checkpoint(const std::string& path) override;
  void restore(const EngineSetup&, const std::string& path) override;
  void stop() override;
  int worker_pid() const override;

 private:
  struct Run;
  void open(const EngineSetup&, const std::string& checkpoint);
  std::string ask(const std::string& message);
  template <class Error = EngineError>
  [[noreturn]] void fail(const std::string& reason);

  std::string worker_path_, name_;
  std::unique_ptr<Run> run_;  // null when not running
};

}  // namespace couloir
