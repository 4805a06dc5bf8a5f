#include "coupling/scene/stl_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

namespace couloir {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t header = 84, record = 50;

template <class T>
T taken(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

bool is_binary(const std::string& bytes) {
  return bytes.size() >= header && bytes.size() == header + record * std::size_t(taken<std::uint32_t>(bytes, 80));
}

std::vector<StlTriangle> binary(const std::string& bytes) {
  std::vector<StlTriangle> out(taken<std::uint32_t>(bytes, 80));
  for (std::size_t n = 0; n < out.size(); ++n) {
    for (int k = 0; k < 9; ++k) {
      const double x = taken<float>(bytes, header + record * n + 4 * std::size_t(3 + k));
      if (!std::isfinite(x)) throw StlError(fmt::format("has a corner that is no number, in triangle {}; export it anew", n + 1));
      out[n][k / 3][k % 3] = x;
    }
  }
  return out;
}

// Words of a text with the line that each stands in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  std::string_view next() {
    skip();
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(from, at_ - from);
  }
  void end_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
  bool at_end() {
    skip();
    return at_ == text_.size();
  }
  int line() const { return line_; }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  void skip() {
    for (; at_ < text_.size() && is_space(text_[at_]); ++at_) line_ += text_[at_] == '\n';
  }
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

bool same_word(std::string_view word, std::string_view lower) {
  const auto low = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
  return word.size() == lower.size() &&
         std::equal(word.begin(), word.end(), lower.begin(), [&](char a, char b) { return low(a) == b; });
}

class TextReader {
 public:
  explicit TextReader(std::string_view text) : words_(text) {}

  std::vector<StlTriangle> all() {
    std::vector<StlTriangle> out;
    want("solid");
    words_.end_line();  // its name
    while (true) {
      const std::string_view word = words_.next();
      if (same_word(word, "facet")) {
        out.push_back(facet());
      } else if (same_word(word, "endsolid")) {
        words_.end_line();
        if (words_.at_end()) return out;
        want("solid");  // several in a file make one body
        words_.end_line();
      } else {
        fail(word, "facet or endsolid");
      }
    }
  }

 private:
  StlTriangle facet() {
    want("normal");
    for (int k = 0; k < 3; ++k) words_.next();
    want("outer"), want("loop");
    StlTriangle triangle;
    for (auto& corner : triangle) {
      want("vertex");
      for (double& x : corner) x = number();
    }
    want("endloop"), want("endfacet");
    return triangle;
  }

  double number() {
    const std::string_view word = words_.next();
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    double x = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(x)) fail(word, "a number");
    return x;
  }

  void want(std::string_view wanted) {
    const std::string_view word = words_.next();
    if (!same_word(word, wanted)) fail(word, wanted);
  }

  [[noreturn]] void fail(std::string_view word, std::string_view wanted) const {
    if (word.empty()) throw StlError(fmt::format("is no whole STL file: it ends where {} should come; export it anew", wanted));
    std::string shown;
    for (const char c : word.substr(0, 20)) shown += c >= ' ' && c <= '~' ? c : '?';
    throw StlError(fmt::format("is no STL file: line {} has '{}' where {} should come; export the body as STL, text or binary",
                               words_.line(), shown, wanted));
  }

  Words words_;
};

}  // namespace

std::vector<StlTriangle> read_stl(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw StlError("does not exist; give the path of an STL file");
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw StlError("cannot be read; look at its permissions");
  if (bytes.empty()) throw StlError("is empty; export the body anew");
  const std::vector<StlTriangle> all = is_binary(bytes) ? binary(bytes) : TextReader(bytes).all();
  if (all.empty()) throw StlError("holds no triangle; export the body anew");
  return all;
}

}  // namespace couloir
