#pragma once
// Runs that checks and studies ask for: each scene once, in a process of its own, kept for the next call.
//
//   scene text + revision -> hash -> FOLDER/<name>-<hash>/summary.json, or a new run
//
// A kept folder that is no done run any more (kept_run.hpp), cut short or edited, is told on stderr and made again.
// A run is made beside its final place and renamed when it is done, so that a folder of that name is always whole. What a call
// that is no more left beside it is gone on with, by `couloir resume`, where it has a checkpoint of this program; else it is
// removed by the next call that makes a run.

#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "coupling/cases/cores.hpp"
#include "coupling/scene/reader.hpp"

namespace couloir {

struct PooledRun {
  nlohmann::json summary;  // null where the run failed
  std::string failure;     // one sentence; empty: done
  std::string folder, hash;
  std::string command;  // that runs it again
  bool reused = false;
  double seconds = 0;  // that it took now
};

class RunPool {
 public:
  // `program`: couloir itself; `folder`: of the runs, made by the first of them; `materials`: as read_scene; `cores`: that the
  // runs under way take together, an engine of several ranks as many.
  RunPool(std::string program, std::string folder, std::string materials, int cores);

  // From now on ends its runs once stop() is true, and begins no more: run() then throws Stopped. What is not done stays for
  // the next call where it has a checkpoint, and is removed where not.
  void stop_when(std::function<bool()> stop) { stop_ = std::move(stop); }
  // Waits for the run; may be called from several threads. Throws SceneError where the scene is wrong, Stopped.
  PooledRun run(const std::string& scene, const Overrides&);
  // What `couloir run` would be told. Throws SceneError where the scene is wrong.
  std::string command(const std::string& scene, const Overrides&) const;
  // Whether an earlier call has done it. Throws SceneError where the scene is wrong.
  bool done(const std::string& scene, const Overrides&) const;
  const std::string& folder() const { return folder_; }

 private:
  struct Place {
    std::string folder, hash;
    int cores;
  };
  Place place_of(const std::string& scene, const Overrides&) const;
  PooledRun make(const Place&, const std::string& scene, const Overrides&);
  void make_folder();
  // Makes what an earlier call left of this run `part`; false: there is nothing.
  bool take_over(const Place&, const std::string& part) const;

  std::string program_, folder_, materials_, revision_;
  std::function<bool()> stop_ = [] { return false; };
  Cores cores_;
  std::once_flag folder_made_;
  std::mutex mutex_;
  std::map<std::string, std::shared_future<PooledRun>> runs_;  // by folder
};

}  // namespace couloir
