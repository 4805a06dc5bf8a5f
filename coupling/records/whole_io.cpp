#include "coupling/records/whole_io.hpp"

#include <unistd.h>

#include <cerrno>

namespace couloir {
namespace {

// `some(done)` moves bytes from the `done`-th on.
template <class F>
std::int64_t until_done(std::size_t count, F&& some) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t moved = some(done);
    if (moved < 0 && errno == EINTR) continue;
    if (moved < 0) return -1;
    if (moved == 0) break;
    done += static_cast<std::size_t>(moved);
  }
  return static_cast<std::int64_t>(done);
}

}  // namespace

std::int64_t read_whole(int file, void* data, std::size_t count, std::uint64_t at) {
  return until_done(count, [&](std::size_t done) {
    return pread(file, static_cast<char*>(data) + done, count - done, static_cast<off_t>(at + done));
  });
}

bool write_whole(int file, const void* data, std::size_t count, std::uint64_t at) {
  return until_done(count, [&](std::size_t done) {
           return pwrite(file, static_cast<const char*>(data) + done, count - done, static_cast<off_t>(at + done));
         }) == static_cast<std::int64_t>(count);
}

bool append_whole(int file, const void* data, std::size_t count) {
  const off_t begin = lseek(file, 0, SEEK_CUR);
  const auto done =
      until_done(count, [&](std::size_t so_far) { return write(file, static_cast<const char*>(data) + so_far, count - so_far); });
  if (done == static_cast<std::int64_t>(count)) return true;
  const int error = errno;
  if (ftruncate(file, begin) == 0) lseek(file, begin, SEEK_SET);
  errno = error;
  return false;
}

}  // namespace couloir
