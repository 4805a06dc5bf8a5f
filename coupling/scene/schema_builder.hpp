#pragma once
// Short words with which schema.cpp writes its table.

#include <numbers>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "coupling/scene/schema.hpp"

namespace couloir::schema_builder {

inline constexpr double deg = std::numbers::pi / 180;

class KeyBuilder {
 public:
  KeyBuilder(std::string path, ValueKind kind, std::string help) {
    key_.path = std::move(path);
    key_.kind = kind;
    key_.help = std::move(help);
  }
  KeyBuilder& dimension(Dimension d) {
    key_.dimension = d;
    return *this;
  }
  KeyBuilder& bounded(Bounds b) {
    key_.bounds = b;
    return *this;
  }
  KeyBuilder& within(double least, double most) { return bounded({least, most, false}); }
  KeyBuilder& above(double least) {
    key_.bounds.least = least;
    key_.bounds.above = true;
    return *this;
  }
  KeyBuilder& upto(double most) {
    key_.bounds.most = most;
    return *this;
  }
  KeyBuilder& with(Presence presence) {
    key_.presence = presence;
    return *this;
  }
  KeyBuilder& required() { return with(Presence::required); }
  KeyBuilder& or_word(const std::string& word) {  // a number's, for 0
    key_.choices = {word};
    return *this;
  }
  KeyBuilder& optional() { return with(Presence::optional); }
  KeyBuilder& unwritten() {
    key_.written = false;
    return *this;
  }
  KeyBuilder& unscaled() {
    key_.scaled = false;
    return *this;
  }
  KeyBuilder& when(std::string selector, std::vector<std::string> selected) {
    key_.selector = std::move(selector);
    key_.selected = std::move(selected);
    return *this;
  }
  Key& key() { return key_; }
  Key build() const { return key_; }

 private:
  Key key_;
};

// The keys in the order in which they are read.
class Keys {
 public:
  void add(const KeyBuilder& builder) { keys_.push_back(builder.build()); }
  void add(const Key& key) { keys_.push_back(key); }
  std::vector<Key> take() { return std::move(keys_); }

 private:
  std::vector<Key> keys_;
};

inline KeyBuilder mapping(const std::string& path, const std::string& help) {
  return {path, ValueKind::mapping, help};
}
// `at(scene)` gives a reference to the vector of entries, each of which has a name.
template <class At>
KeyBuilder named(const std::string& path, const std::string& help, At at) {
  KeyBuilder builder(path, ValueKind::named, help);
  builder.key().entries = [at](const Scene& s, int) {
    std::vector<Entry> entries;
    for (const auto& entry : at(s)) entries.push_back({entry.name, static_cast<int>(entries.size())});
    return entries;
  };
  builder.key().append = [at](Scene& s, int, const std::string& name) {
    at(s).emplace_back().name = name;
    return static_cast<int>(at(s).size()) - 1;
  };
  return builder;
}

// `at(scene)` gives a reference to the vector of entries.
template <class At>
KeyBuilder list(const std::string& path, const std::string& help, At at) {
  KeyBuilder builder(path, ValueKind::list, help);
  builder.key().entries = [at](const Scene& s, int) {
    std::vector<Entry> entries(at(s).size());
    for (std::size_t n = 0; n < entries.size(); ++n) entries[n].index = static_cast<int>(n);
    return entries;
  };
  builder.key().append = [at](Scene& s, int, const std::string&) {
    at(s).emplace_back();
    return static_cast<int>(at(s).size()) - 1;
  };
  return builder;
}

// A number that the reader keeps for itself.
inline KeyBuilder own_number(const std::string& path, Dimension dimension, const std::string& help) {
  return KeyBuilder(path, ValueKind::number, help).dimension(dimension);
}

// `at(scene, index)` gives a reference to the member.
template <class At>
KeyBuilder number(const std::string& path, Dimension dimension, const std::string& help, At at) {
  KeyBuilder builder = own_number(path, dimension, help);
  builder.key().get = [at](const Scene& s, int i) -> Value { return static_cast<double>(at(s, i)); };
  builder.key().set = [at](Scene& s, int i, const Value& v) { at(s, i) = std::get<double>(v); };
  return builder;
}

// `at(scene, index)` gives a std::tie of the members.
template <class At>
KeyBuilder numbers(const std::string& path, Dimension dimension, const std::string& help, At at) {
  using Tie = std::invoke_result_t<At, Scene&, int>;
  KeyBuilder builder = KeyBuilder(path, ValueKind::numbers, help).dimension(dimension);
  builder.key().count = static_cast<int>(std::tuple_size_v<Tie>);
  builder.key().get = [at](const Scene& s, int i) -> Value {
    return std::apply([](const auto&... x) { return std::vector<double>{x...}; }, at(s, i));
  };
  builder.key().set = [at](Scene& s, int i, const Value& v) {
    std::size_t n = 0;
    const auto& list = std::get<std::vector<double>>(v);
    std::apply([&](auto&... x) { ((x = list[n++]), ...); }, at(s, i));
  };
  return builder;
}

template <class At>
KeyBuilder integer(const std::string& path, const std::string& help, At at) {
  KeyBuilder builder(path, ValueKind::integer, help);
  builder.key().get = [at](const Scene& s, int i) -> Value { return static_cast<long>(at(s, i)); };
  builder.key().set = [at](Scene& s, int i, const Value& v) {
    auto& member = at(s, i);
    member = static_cast<std::remove_reference_t<decltype(member)>>(std::get<long>(v));
  };
  return builder;
}

template <class At>
KeyBuilder text(const std::string& path, const std::string& help, At at) {
  KeyBuilder builder(path, ValueKind::text, help);
  builder.key().get = [at](const Scene& s, int i) -> Value { return at(s, i); };
  builder.key().set = [at](Scene& s, int i, const Value& v) { at(s, i) = std::get<std::string>(v); };
  return builder;
}

// A choice kept as the word itself.
template <class At>
KeyBuilder word(const std::string& path, const std::string& help, std::vector<std::string> choices, At at) {
  KeyBuilder builder = text(path, help, at);
  builder.key().kind = ValueKind::choice;
  builder.key().choices = std::move(choices);
  return builder;
}

// A choice kept as an enum whose values are the choices in order.
template <class At>
KeyBuilder choice(const std::string& path, const std::string& help, const std::vector<std::string>& choices, At at) {
  KeyBuilder builder(path, ValueKind::choice, help);
  builder.key().choices = choices;
  builder.key().get = [at, choices](const Scene& s, int i) -> Value { return choices[static_cast<std::size_t>(at(s, i))]; };
  builder.key().set = [at, choices](Scene& s, int i, const Value& v) {
    auto& member = at(s, i);
    for (std::size_t n = 0; n < choices.size(); ++n) {
      if (std::get<std::string>(v) == choices[n]) member = static_cast<std::remove_reference_t<decltype(member)>>(n);
    }
  };
  return builder;
}

void add_continuum(Keys&);                                            // schema_continuum.cpp
void add_grains(Keys&);                                               // schema_grains.cpp
void add_obstacles(Keys&);                                            // schema_obstacles.cpp
void add_grain_material(Keys&, const std::string& prefix, Presence);  // schema_grains.cpp

}  // namespace couloir::schema_builder
