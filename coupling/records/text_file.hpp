#pragma once
// A text file that is written line by line and is on the disk after each: what a killed run leaves is complete to its last line.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace couloir {

class TextFile {
 public:
  // Empties the file, or goes on after its last line with `append`. Throws RecordError.
  explicit TextFile(const std::string& path, bool append = false);
  // Adds the newline. Throws RecordError, e.g. on a full disk; after that the file is given up and further lines are dropped,
  // so that the end of a failed run can still be told to the other observers.
  void line(const std::string& text);
  // The same, followed by a closing `tail` that the next line will overwrite: the file is complete at any time.
  void line_before(const std::string& text, const std::string& tail);
  void tail(const std::string&);  // the closing one alone
  const std::string& path() const { return path_; }

  // For checkpoints: how long it is, without a closing tail, once all is on the disk; and back to that length, which is where the
  // next line goes. Both throw RecordError.
  std::int64_t settled();
  void go_back(std::int64_t length);
  // A file of an earlier process, back to that length.
  static TextFile reopened(const std::string& path, std::int64_t length);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  TextFile(const std::string& path, const char* mode);
  void write(const std::string& text);

  std::string path_;
  bool given_up_ = false;
  std::unique_ptr<std::FILE, Close> file_;
};

// The whole text under its final name or not at all: written beside it, then renamed. Throws RecordError.
void write_atomically(const std::string& path, const std::string& text);

// The whole file. Throws RecordError.
std::string read_text(const std::string& path);

}  // namespace couloir
