#pragma once
// Runs that checks ask for: each scene once, in a process of its own, kept for the next call.
//
//   scene text + revision -> hash -> FOLDER/<name>-<hash>/summary.json, or a new run
//
// A run is made beside its final place and renamed when it is done, so that a folder of that name is always whole.

#include <future>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "coupling/scene/reader.hpp"

namespace couloir {

struct CheckedRun {
  nlohmann::json summary;  // null where the run failed
  std::string failure;     // one sentence; empty: done
  std::string folder;
  std::string command;  // that runs it again
  bool reused = false;
  double seconds = 0;  // that it took now
};

class RunPool {
 public:
  // `program`: couloir itself; `folder`: of the runs, made where it is missing; `materials`: as read_scene.
  RunPool(std::string program, std::string folder, std::string materials);

  // Waits for the run; may be called from several threads. Throws SceneError where the scene is wrong.
  CheckedRun run(const std::string& scene, const Overrides&);
  // What `couloir run` would be told. Throws SceneError where the scene is wrong.
  std::string command(const std::string& scene, const Overrides&) const;

 private:
  CheckedRun make(const std::string& folder, const std::string& scene, const Overrides&) const;

  std::string program_, folder_, materials_, revision_;
  std::mutex mutex_;
  std::map<std::string, std::shared_future<CheckedRun>> runs_;  // by folder
};

}  // namespace couloir
