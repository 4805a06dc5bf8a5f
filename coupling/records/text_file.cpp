#include "coupling/records/text_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "coupling/records/record_error.hpp"

namespace couloir {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw RecordError(path + " could not be written: " + std::strerror(errno) + "; free space there or choose another --out");
}

}  // namespace

TextFile::TextFile(const std::string& path, const char* mode) : path_(path), file_(std::fopen(path.c_str(), mode)) {
  if (!file_) fail(path);
}

TextFile::TextFile(const std::string& path, bool append) : TextFile(path, append ? "a" : "w") {}

TextFile TextFile::reopened(const std::string& path, std::int64_t length) {
  TextFile file(path, "r+");
  file.go_back(length);
  return file;
}

std::int64_t TextFile::settled() {
  if (fsync(fileno(file_.get())) != 0) fail(path_);
  return std::ftell(file_.get());
}

void TextFile::go_back(std::int64_t length) {
  struct stat now {};
  if (fstat(fileno(file_.get()), &now) != 0) fail(path_);
  if (now.st_size < length)
    throw RecordError(path_ + " is shorter than it was at the checkpoint: it is not the file of this run any more");
  if (ftruncate(fileno(file_.get()), length) != 0 || std::fseek(file_.get(), length, SEEK_SET) != 0) fail(path_);
}

void TextFile::write(const std::string& text) {
  if (given_up_) return;
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size() && std::fflush(file_.get()) == 0) return;
  given_up_ = true;
  fail(path_);
}

void TextFile::line(const std::string& text) {
  write(text + "\n");
}

void TextFile::line_before(const std::string& text, const std::string& tail) {
  write(text + "\n");
  this->tail(tail);
}

void TextFile::tail(const std::string& tail) {
  const long end = std::ftell(file_.get());
  write(tail + "\n");
  std::fseek(file_.get(), end, SEEK_SET);
}

void write_atomically(const std::string& path, const std::string& text) {
  const std::string beside = path + ".tmp";
  try {
    TextFile(beside).line(text);
  } catch (const RecordError&) {
    std::remove(beside.c_str());
    throw;
  }
  if (std::rename(beside.c_str(), path.c_str()) != 0) fail(path);
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw RecordError(path + " could not be read; is this the folder of a run?");
  return text.str();
}

}  // namespace couloir
