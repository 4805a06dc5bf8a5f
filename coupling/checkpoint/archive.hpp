#pragma once
// The state of a run as bytes and back. A class names what it holds once, for both ways:
//
//   void state(Archive& a) { a(position_, owed_, passed_); }
//
// Values without pointers (numbers, structures of numbers) go as they lie in memory, so a member added to such a structure is
// kept without a word; vectors, strings, optionals and classes with a state() go member by member. Same program, same machine.

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "coupling/checkpoint/checkpoint_error.hpp"

namespace couloir {

class Archive {
 public:
  // To be filled, of the checkpoint with this number.
  explicit Archive(std::int64_t number = 0) : number_(number) {}
  Archive(std::int64_t number, std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)), number_(number), loading_(true) {}

  bool loading() const { return loading_; }
  std::int64_t number() const { return number_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  bool at_end() const { return at_ == bytes_.size(); }

  // Throws CheckpointError where loading finds fewer bytes than it needs.
  template <class... T>
  void operator()(T&... values) {
    (one(values), ...);
  }

 private:
  template <class T>
  static constexpr bool is_plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

  template <class T>
  void one(T& value) {
    static_assert(!std::is_const_v<T>, "what is saved must also take what is loaded");
    if constexpr (requires { value.state(*this); }) {
      value.state(*this);
    } else {
      static_assert(is_plain<T>, "give it a member state(Archive&)");
      raw(&value, sizeof value);
    }
  }
  template <class T>
  void one(std::vector<T>& all) {
    const std::size_t count = length(all.size());
    if constexpr (is_plain<T>) {
      need(count, sizeof(T));
      all.resize(count);
      if (count > 0) raw(all.data(), count * sizeof(T));
    } else {
      if constexpr (std::is_default_constructible_v<T>) {
        need(count, 1);
        all.resize(count);
      } else if (all.size() != count) {
        throw CheckpointError("the checkpoint belongs to a run with other parts");
      }
      for (T& value : all) one(value);
    }
  }
  void one(std::string& text) {
    const std::size_t count = length(text.size());
    need(count, 1);
    text.resize(count);
    raw(text.data(), count);
  }
  template <class T>
  void one(std::optional<T>& value) {
    bool there = value.has_value();
    one(there);
    if (!there) value.reset();
    if (there && !value) value.emplace();
    if (there) one(*value);
  }

  std::size_t length(std::size_t present) {
    std::uint64_t count = present;
    raw(&count, sizeof count);
    return count;
  }
  void need(std::size_t count, std::size_t size) const {
    if (loading_ && count > (bytes_.size() - at_) / size) throw CheckpointError("the checkpoint is cut short");
  }
  void raw(void* data, std::size_t size) {
    auto* p = static_cast<std::uint8_t*>(data);
    if (!loading_) {
      bytes_.insert(bytes_.end(), p, p + size);
      return;
    }
    need(size, 1);
    std::memcpy(p, bytes_.data() + at_, size);
    at_ += size;
  }

  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::int64_t number_;
  bool loading_ = false;
};

}  // namespace couloir
