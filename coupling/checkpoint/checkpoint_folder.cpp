#include "coupling/checkpoint/checkpoint_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "coupling/checkpoint/archive.hpp"
#include "coupling/checkpoint/checksum.hpp"
#include "coupling/checkpoint/safe_file.hpp"

namespace couloir {
namespace {

namespace fs = std::filesystem;

constexpr const char* format = "couloir checkpoint 1";

std::string state_file(const std::string& folder) {
  return folder + "/state";
}

std::uint64_t sum_of(const std::vector<std::uint8_t>& bytes) {
  return checksum(bytes.data(), bytes.size());
}

void fields(Archive& a, Checkpoint& c) {
  a(c.number, c.time, c.made_by, c.scene, c.state);
}

std::vector<std::uint8_t> bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// Whether a file is one of the engines' of a checkpoint; `first`: the first engine's.
bool of_engine(const fs::path& file, const std::string& first) {
  return file.string() == first || file.string().starts_with(first + ".");
}

}  // namespace

CheckpointFolder::CheckpointFolder(std::string path) : path_(std::move(path)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw CheckpointError(path_ + " cannot be made: " + error.message());
}

CheckpointFolder::~CheckpointFolder() {
  if (lock_ >= 0) close(lock_);
}

bool CheckpointFolder::lock() {
  if (lock_ >= 0) return true;
  lock_ = open((path_ + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) throw CheckpointError(path_ + "/lock could not be written: " + std::strerror(errno));
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return true;
  close(lock_);
  lock_ = -1;
  return false;
}

std::string CheckpointFolder::engine_file(std::int64_t number, int engine) const {
  return path_ + "/engine." + std::to_string(number) + (engine > 0 ? "." + std::to_string(engine) : "");
}

std::string CheckpointFolder::journal(const std::string& path, std::int64_t number) {
  return path + "/records." + std::to_string(number) + ".undo";
}

void CheckpointFolder::commit(Checkpoint& checkpoint) {
  const std::string engine = engine_file(checkpoint.number);
  for (const auto& entry : fs::directory_iterator(path_))
    if (of_engine(entry.path(), engine)) sync_file(entry.path());
  Archive body;
  fields(body, checkpoint);
  std::string form = format;
  std::uint64_t sum = sum_of(body.bytes());
  std::vector<std::uint8_t> bytes = body.bytes();
  Archive file;
  file(form, sum, bytes);
  write_safely(state_file(path_), file.bytes());
  remove_others(checkpoint.number);
}

void CheckpointFolder::remove_others(std::int64_t number) const {
  const std::string engine = engine_file(number), undo = fs::path(journal(path_, number)).filename();
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename();
    if (name != "state" && name != "lock" && !of_engine(entry.path(), engine) && name != undo) others.push_back(entry.path());
  }
  std::error_code ignored;
  for (const fs::path& path : others) fs::remove(path, ignored);
}

void CheckpointFolder::clear() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

bool CheckpointFolder::holds_one(const std::string& path) {
  return fs::exists(state_file(path));
}

Checkpoint CheckpointFolder::read(const std::string& path) {
  const std::string name = state_file(path);
  if (!fs::exists(name)) throw CheckpointError(name + " does not exist");
  Checkpoint out;
  try {
    Archive file(0, bytes_of(name));
    std::string form;
    std::uint64_t sum = 0;
    std::vector<std::uint8_t> bytes;
    file(form);
    if (form != format) throw CheckpointError("it is of another format than '" + std::string(format) + "'");
    file(sum, bytes);
    if (sum != sum_of(bytes)) throw CheckpointError("its bytes are not those that were written");
    Archive body(0, std::move(bytes));
    fields(body, out);
  } catch (const CheckpointError& error) {
    throw CheckpointError(name + " cannot be read: " + error.what());
  }
  return out;
}

}  // namespace couloir
