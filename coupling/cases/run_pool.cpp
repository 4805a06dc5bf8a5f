#include "coupling/cases/run_pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <thread>
#include <vector>

#include "coupling/cases/for_shell.hpp"
#include "coupling/cases/kept_run.hpp"
#include "coupling/cases/share_out.hpp"
#include "coupling/checkpoint/checkpoint_error.hpp"
#include "coupling/checkpoint/checkpoint_folder.hpp"
#include "coupling/checkpoint/checksum.hpp"
#include "coupling/records/provenance.hpp"
#include "coupling/records/record_error.hpp"
#include "coupling/records/run_folder.hpp"

extern char** environ;

namespace couloir {
namespace {

namespace fs = std::filesystem;

std::uint64_t hash_of(const std::string& text) {
  return checksum(text.data(), text.size());
}

std::vector<std::string> words_of(const std::string& scene, const Overrides& set) {
  std::vector<std::string> words{"run", scene};
  for (const auto& [key, value] : set) words.insert(words.end(), {"--set", key + "=" + value});
  return words;
}

// The last line that a failed run left on its screen.
std::string last_line(const std::string& path) {
  std::ifstream file(path);
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line.rfind("couloir: what was computed", 0) != 0) last = line;
  return last;
}

// How it ended, empty where it did well: "ended with exit code 3". In a process group of its own, so that it hears of Ctrl-C from
// us alone, once: at a second signal it would not save its state.
std::string run_program(const std::string& program, std::vector<std::string> words, const std::string& log,
                        const std::function<bool()>& stop) {
  words.insert(words.begin(), program);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, 2, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t pid = 0;
  const int error = posix_spawn(&pid, program.c_str(), &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return fmt::format("could not be started: {}", std::strerror(error));
  int status = 0;
  for (bool told = false; waitpid(pid, &status, WNOHANG) != pid; std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
    if (told || !stop()) continue;
    kill(pid, SIGTERM);
    told = true;
  }
  if (!WIFEXITED(status)) return fmt::format("was killed by signal {}", WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

// <name>-<hash>.part-<process>, or its .log, of a process that is no more.
bool is_left_behind(const std::string& name) {
  static const std::regex part(".+-[0-9a-f]{16}\\.part-([1-9][0-9]{0,8})(\\.log)?");
  std::smatch found;
  return std::regex_match(name, found, part) && kill(std::stoi(found[1]), 0) != 0 && errno == ESRCH;
}

// Whether `couloir resume`, by this program, goes on with it.
bool can_go_on(const fs::path& run, const std::string& program) {
  try {
    return CheckpointFolder::read((run / "checkpoint").string()).made_by == program;
  } catch (const CheckpointError&) {
    return false;
  }
}

// Takes a damaged run away, so that it can be made again; why that failed, or nothing.
std::string cleared(const std::string& folder, const KeptRun& kept) {
  if (!kept.is_there) return "";
  // On a terminal over the line of progress.
  fmt::print(stderr, "{}couloir: {} is damaged ({}) and is made again\n", isatty(STDERR_FILENO) ? "\r\x1b[K" : "", folder,
             kept.fault);
  std::error_code error;
  fs::remove_all(folder, error);
  return error ? fmt::format("{} is damaged and cannot be removed: {}; remove it", folder, error.message()) : "";
}

// A run's folder, of its own name or its log's.
fs::path run_of(const fs::path& left) {
  return left.extension() == ".log" ? fs::path(left).replace_extension() : left;
}

}  // namespace

RunPool::RunPool(std::string program, std::string folder, std::string materials, int cores)
    : program_(std::move(program)),
      folder_(std::move(folder)),
      materials_(std::move(materials)),
      revision_(build_identity(program_)),
      cores_(cores) {}

void RunPool::make_folder() {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw RecordError(fmt::format("{} cannot be made: {}", folder_, error.message()));
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(folder_))
    if (is_left_behind(entry.path().filename().string()) && !can_go_on(run_of(entry.path()), revision_))
      left.push_back(entry.path());
  for (const fs::path& path : left) fs::remove_all(path, error);
}

std::string RunPool::command(const std::string& scene, const Overrides& set) const {
  std::string out = "couloir";
  for (const std::string& word : words_of(scene, set)) out += " " + for_shell(word);
  return out;
}

bool RunPool::take_over(const Place& place, const std::string& part) const {
  const std::string begin = fs::path(place.folder).filename().string() + ".part-";
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !is_left_behind(name) || !can_go_on(entry.path(), revision_)) continue;
    std::error_code taken, ignored;
    fs::rename(entry.path(), part, taken);
    fs::remove(entry.path().string() + ".log", ignored);
    return !taken;
  }
  return false;
}

RunPool::Place RunPool::place_of(const std::string& scene, const Overrides& set) const {
  const Scene read = read_scene(scene, materials_, set);
  const std::string hash = fmt::format("{:016x}", hash_of(write_scene(read) + "\n" + revision_));
  return {(fs::path(folder_) / fmt::format("{}-{}", scene_name(read), hash)).string(), hash,
          read.mode == Mode::continuum ? 1 : read.grains.ranks};
}

bool RunPool::done(const std::string& scene, const Overrides& set) const {
  return kept_run(place_of(scene, set).folder).done();
}

PooledRun RunPool::run(const std::string& scene, const Overrides& set) {
  const Place place = place_of(scene, set);
  std::promise<PooledRun> promise;
  std::shared_future<PooledRun> result;
  bool ours = false;
  {
    const std::lock_guard lock(mutex_);
    const auto [at, added] = runs_.try_emplace(place.folder);
    if (added) at->second = promise.get_future().share();
    result = at->second;
    ours = added;
  }
  if (ours) {
    try {
      promise.set_value(make(place, scene, set));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return result.get();
}

PooledRun RunPool::make(const Place& place, const std::string& scene, const Overrides& set) {
  PooledRun out;
  out.folder = place.folder;
  out.hash = place.hash;
  out.command = command(scene, set);
  KeptRun kept = kept_run(place.folder);
  if (kept.done()) {
    out.summary = std::move(kept.summary);
    out.reused = true;
    return out;
  }
  std::call_once(folder_made_, [&] { make_folder(); });
  const Cores::Hold held(cores_, place.cores);
  if (stop_()) throw Stopped();
  if (out.failure = cleared(place.folder, kept); !out.failure.empty()) return out;
  const std::string part = fmt::format("{}.part-{}", place.folder, getpid()), log = part + ".log";
  fs::remove_all(part);
  std::vector<std::string> words{"resume", part};
  if (!take_over(place, part)) {
    words = words_of(scene, set);
    words.insert(words.end(), {"--out", part});
  }
  words.push_back("--no-report");
  const auto start = std::chrono::steady_clock::now();
  const std::string bad_end = run_program(program_, words, log, stop_);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!bad_end.empty() && stop_()) {
    if (!can_go_on(part, revision_)) {
      fs::remove_all(part);
      fs::remove(log);
    }
    throw Stopped();
  }
  if (!bad_end.empty()) {
    const std::string said = last_line(log);
    out.failure = fmt::format("the run {}{}; what it left is in {}", bad_end, said.empty() ? "" : ": " + said, part);
    return out;
  }
  fs::remove(log);
  std::error_code taken;
  fs::rename(part, place.folder, taken);
  kept = kept_run(place.folder);
  if (taken && kept.done())
    fs::remove_all(part);  // another call has made the same run in the meantime
  else if (taken)
    out.failure = fmt::format("{} cannot be renamed to {}: {}; move that away", part, place.folder, taken.message());
  else if (!kept.done())
    out.failure = fmt::format("{} is damaged: {}; is the disk full?", place.folder, kept.fault);
  out.summary = std::move(kept.summary);
  return out;
}

}  // namespace couloir
