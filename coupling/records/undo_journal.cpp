#include "coupling/records/undo_journal.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "coupling/records/record_error.hpp"
#include "coupling/records/whole_io.hpp"

namespace couloir {
namespace {

constexpr std::uint64_t page_size = 4096;

struct Note {
  std::uint64_t page = 0;
  std::array<std::uint8_t, page_size> bytes{};
};

[[noreturn]] void fail(const std::string& path, const char* doing) {
  throw RecordError(path + " could not be " + doing + ": " + std::strerror(errno));
}

struct OpenFile {
  int id;
  ~OpenFile() {
    if (id >= 0) close(id);
  }
};

}  // namespace

UndoJournal::~UndoJournal() {
  if (journal_ >= 0) close(journal_);
}

void UndoJournal::begin(const std::string& path, std::uint64_t size) {
  if (journal_ >= 0) close(journal_);
  journal_ = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (journal_ < 0) fail(path, "written");
  size_ = size;
  noted_.assign((size + page_size - 1) / page_size, false);
}

bool UndoJournal::note(int file, std::uint64_t at, std::uint64_t count) {
  if (journal_ < 0 || at >= size_ || count == 0) return true;
  const std::uint64_t last = (std::min(at + count, size_) - 1) / page_size;
  for (std::uint64_t page = at / page_size; page <= last; ++page) {
    if (noted_[page]) continue;
    Note note{page, {}};
    if (read_whole(file, note.bytes.data(), page_size, page * page_size) < 0) return false;
    if (!append_whole(journal_, &note, sizeof note)) return false;
    noted_[page] = true;
  }
  return true;
}

void UndoJournal::roll_back(const std::string& file, const std::string& journal, std::uint64_t size) {
  const OpenFile records{open(file.c_str(), O_RDWR | O_CLOEXEC)};
  if (records.id < 0) fail(file, "opened");
  const OpenFile notes{open(journal.c_str(), O_RDONLY | O_CLOEXEC)};
  if (notes.id < 0 && errno != ENOENT) fail(journal, "read");
  for (std::uint64_t k = 0; notes.id >= 0; ++k) {
    Note note;
    const std::int64_t got = read_whole(notes.id, &note, sizeof note, k * sizeof note);
    if (got < 0) fail(journal, "read");
    if (got < static_cast<std::int64_t>(sizeof note)) break;
    if (!write_whole(records.id, note.bytes.data(), page_size, note.page * page_size)) fail(file, "written");
  }
  struct stat now {};  // the file may have shrunk since; what it lost was noted
  if (fstat(records.id, &now) != 0) fail(file, "read");
  if (static_cast<std::uint64_t>(now.st_size) < size)
    throw RecordError(file + " is shorter than it was at the checkpoint: it is not the file of this run any more");
  if (ftruncate(records.id, static_cast<off_t>(size)) != 0 || fsync(records.id) != 0) fail(file, "written");
}

}  // namespace couloir
