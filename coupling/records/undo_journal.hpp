#pragma once
// What a file held at a checkpoint, page by page, as far as it was written over since. HDF5 writes in place and cannot be stopped
// half-way; with the journal a file is again, to the byte, what it was at the checkpoint, whenever its writer ended.
//
//   journal = (page number, 4096 bytes)*     a page is noted once, before it changes; a note cut short has changed nothing yet

#include <cstdint>
#include <string>
#include <vector>

namespace couloir {

class UndoJournal {
 public:
  UndoJournal() = default;
  ~UndoJournal();
  UndoJournal(const UndoJournal&) = delete;
  UndoJournal& operator=(const UndoJournal&) = delete;

  // From now on notes, in a new file `path`, what lies below `size` bytes. Throws RecordError.
  void begin(const std::string& path, std::uint64_t size);
  // These bytes of the open file are about to change. False, with errno, where a note cannot be written: then leave them.
  bool note(int file, std::uint64_t at, std::uint64_t count);

  // Makes `file` what it was when its journal began with this size; a journal that does not exist holds nothing. May be done
  // again. Throws RecordError.
  static void roll_back(const std::string& file, const std::string& journal, std::uint64_t size);

 private:
  int journal_ = -1;
  std::uint64_t size_ = 0;
  std::vector<bool> noted_;  // by page
};

}  // namespace couloir
