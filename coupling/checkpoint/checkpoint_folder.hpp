#pragma once
// RUN/checkpoint: the last whole checkpoint of a run.
//
//   state              which one it is, what made it, the scene, and all but the engine's part
//   engine.<n>*        the grain engines' own files (their port's checkpoint), of the second one engine.<n>.1 and so on
//   records.<n>.undo   what records.h5 held before what was written into it since (records/undo_journal.hpp)
//   lock               held by the process that runs
//
// Number n counts up. Everything of number n is on the disk before `state`, which names n, takes the place of the one before by
// a rename; then the files of other numbers go. So whatever stops a run, one checkpoint is whole.

#include <cstdint>
#include <string>
#include <vector>

namespace couloir {

struct Checkpoint {
  std::int64_t number = 0;
  double time = 0;                  // [s] simulated
  std::string made_by;              // the program's revision
  std::string scene;                // its text as run
  std::vector<std::uint8_t> state;  // an Archive's
};

class CheckpointFolder {
 public:
  // Makes the folder where it is missing. Throws CheckpointError.
  explicit CheckpointFolder(std::string path);
  CheckpointFolder(const CheckpointFolder&) = delete;
  CheckpointFolder& operator=(const CheckpointFolder&) = delete;
  ~CheckpointFolder();

  // False where another process holds it. Given back when the object, or the process, ends.
  bool lock();

  std::string engine_file(std::int64_t number, int engine = 0) const;
  // The engine's files of this number must be there. Throws CheckpointError; the checkpoint before is then still whole.
  void commit(Checkpoint&);
  void clear();  // the run is done: nothing to go on from

  static std::string journal(const std::string& path, std::int64_t number);
  static bool holds_one(const std::string& path);
  // Throws CheckpointError where there is none, or it is damaged.
  static Checkpoint read(const std::string& path);

 private:
  void remove_others(std::int64_t number) const;

  std::string path_;
  int lock_ = -1;
};

}  // namespace couloir
