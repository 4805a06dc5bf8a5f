#include "coupling/checkpoint/safe_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "coupling/checkpoint/checkpoint_error.hpp"

namespace couloir {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw CheckpointError(path + " could not be written: " + std::strerror(errno));
}

// A file or folder, as opened for reading.
void sync(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path);
  const bool done = fsync(file) == 0;
  const int error = errno;
  close(file);
  errno = error;
  if (!done) fail(path);
}

bool write_all(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

void write_safely(const std::string& path, std::span<const std::uint8_t> bytes) {
  const std::string part = path + ".part";
  const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail(part);
  const bool done = write_all(file, bytes) && fsync(file) == 0;
  const int error = errno;
  const bool closed = close(file) == 0;
  if (!done || !closed) {
    if (!done) errno = error;
    const int reason = errno;
    unlink(part.c_str());
    errno = reason;
    fail(path);
  }
  if (std::rename(part.c_str(), path.c_str()) != 0) fail(path);
  sync(std::filesystem::absolute(path).parent_path().string());
}

void sync_file(const std::string& path) {
  sync(path);
}

}  // namespace couloir
