#include "coupling/scene/binder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/schema.hpp"

namespace couloir {
namespace {

std::string keys_of(const std::string& mapping) {
  std::vector<std::string> names;
  for (const Key* key : children(mapping)) names.push_back(key->name());
  return fmt::format("{}", fmt::join(names, ", "));
}

// What a key wants to be given, for messages: "a length in m, mm, cm, km", "one of wall, outflow".
std::string wanted(const Key& key) {
  const auto units = units_of(key.dimension);
  const std::string unit = units.empty() ? "" : fmt::format(" in {}", fmt::join(units, ", "));
  switch (key.kind) {
    case ValueKind::number:
      return (key.choices.empty() ? "" : key.choices.front() + ", or ") + describe(key.dimension) + unit;
    case ValueKind::numbers:
      return fmt::format("a list of {} numbers{}", key.count, unit);
    case ValueKind::table:
      return fmt::format("a list of rows of {} numbers", key.columns.size());
    case ValueKind::integer:
      return "a whole number";
    case ValueKind::text:
      return "a text";
    case ValueKind::choice:
      return fmt::format("one of {}", fmt::join(key.choices, ", "));
    case ValueKind::mapping:
    case ValueKind::named:
    case ValueKind::list:
      break;
  }
  const std::string form = key.kind == ValueKind::named  ? "a mapping from names to mappings"
                           : key.kind == ValueKind::list ? "a list of mappings, each with " + keys_of(key.path + ".*")
                                                         : "a mapping with " + keys_of(key.path);
  return key.choices.empty() ? form : fmt::format("one of {}, or {}", fmt::join(key.choices, ", "), form);
}

class Binder {
 public:
  explicit Binder(Scene& scene) : scene_(scene) {}

  // One mapping; `pattern` is its path in the schema, `path` as the user wrote it.
  // `named_in`: what holds it under a name of the user's, if something does.
  void mapping(const Node& node, const std::string& pattern, const std::string& path, int index, const Node* named_in = nullptr) {
    const auto keys = children(pattern);
    refuse_unknown(node, keys, path);
    for (const Key* key : keys) {
      const std::string full = joined(path, key->name());
      const Node* entry = node.find(key->name());
      if (!belongs(*key, index)) {
        if (entry) refuse_misplaced(*entry, *key, full, index);
        continue;
      }
      if (entry) {
        scene_.places.note(full, entry->place);
        value(*entry, *key, full, index);
      } else if (key->presence == Presence::required) {
        throw SceneError(
            fmt::format("{}: {} is missing: {}; give {}{}", node.place, full, key->help, wanted(*key), twin(path, named_in)));
      }
    }
  }

 private:
  static std::string joined(const std::string& path, const std::string& name) { return path.empty() ? name : path + "." + name; }

  const Key* selector_of(const Key& key) const {
    return key.selector.empty() ? nullptr : &schema_key(joined(key.parent(), key.selector));
  }
  std::string selection(const Key& key, int index) const { return std::get<std::string>(selector_of(key)->get(scene_, index)); }
  bool belongs(const Key& key, int index) const {
    return key.selector.empty() || std::ranges::count(key.selected, selection(key, index)) > 0;
  }

  void refuse_unknown(const Node& node, const std::vector<const Key*>& keys, const std::string& path) const {
    std::vector<std::string> names;
    for (const Key* key : keys) names.push_back(key->name());
    for (const auto& [name, entry] : node.entries) {
      if (std::ranges::count(names, name) > 0) continue;
      const std::string what = (path.empty() ? std::string("a scene") : path) + " takes";
      throw SceneError(fmt::format("{}: {} is unknown{}", entry.place, joined(path, name), suggestion(name, names, what)));
    }
  }

  [[noreturn]] void refuse_misplaced(const Node& entry, const Key& key, const std::string& full, int index) const {
    throw SceneError(fmt::format("{}: {} does not belong to {} '{}'; it is for {}", entry.place, full, key.selector,
                                 selection(key, index), fmt::join(key.selected, ", ")));
  }

  [[noreturn]] void fail(const Node& node, const std::string& full, const std::string& what) const {
    throw SceneError(fmt::format("{}: {} {}", node.place, full, what));
  }

  void value(const Node& node, const Key& key, const std::string& full, int index) {
    switch (key.kind) {
      case ValueKind::number:
        number(node, key, full, index);
        break;
      case ValueKind::numbers:
        numbers(node, key, full, index);
        break;
      case ValueKind::table:
        table(node, key, full, index);
        break;
      case ValueKind::integer:
        integer(node, key, full, index);
        break;
      case ValueKind::text:
        key.set(scene_, index, text_of(node, key, full));
        break;
      case ValueKind::choice:
        choice(node, key, full, index);
        break;
      case ValueKind::mapping:
        section(node, key, full, index);
        break;
      case ValueKind::named:
        named(node, key, full, index);
        break;
      case ValueKind::list:
        list(node, key, full, index);
        break;
    }
  }

  // Half a body of a name like another's is a slip of the pen.
  static std::string twin(const std::string& path, const Node* named_in) {
    if (!named_in) return "";
    const std::size_t dot = path.rfind('.');
    const std::string name = path.substr(dot + 1);
    std::vector<std::string> others;
    for (const auto& entry : named_in->entries)
      if (entry.first != name) others.push_back(entry.first);
    const std::string like = nearest_name(name, others);
    return like.empty() ? "" : fmt::format("; or did you mean {}.{}?", path.substr(0, dot), like);
  }

  const std::string& text_of(const Node& node, const Key& key, const std::string& full) const {
    if (node.kind != Node::Kind::text) fail(node, full, fmt::format("is {}, but must be {}", describe(node), wanted(key)));
    return node.text;
  }

  double quantity(const Node& node, const Key& key, const std::string& full) const {
    const std::string& text = text_of(node, key, full);
    try {
      const Scales scales =
          node.si || !key.set || !key.scaled ? Scales{} : Scales{scale_length_, scene_.gravity, scene_.material.density};
      const double x = parse_quantity(text, key.dimension, scales);
      refuse_outside(x, node, key, full);
      return x;
    } catch (const QuantityError& error) {
      fail(node, full, error.what());
    }
  }

  void refuse_outside(double x, const Node& node, const Key& key, const std::string& full) const {
    const Bounds& b = key.bounds;
    if (x < b.least || x > b.most || (b.above && x == b.least)) {
      fail(node, full, fmt::format("is {}, out of bounds: it must be {}", node.text, allowed_values(key)));
    }
  }

  void number(const Node& node, const Key& key, const std::string& full, int index) {
    const bool word = node.kind == Node::Kind::text && std::ranges::count(key.choices, node.text) > 0;
    const double x = word ? 0 : quantity(node, key, full);
    if (key.set) {
      key.set(scene_, index, x);
    } else {
      scale_length_ = x;  // the one number that is the reader's own
    }
  }

  void numbers(const Node& node, const Key& key, const std::string& full, int index) {
    if (node.kind != Node::Kind::list) fail(node, full, fmt::format("is {}, but must be {}", describe(node), wanted(key)));
    if (static_cast<int>(node.items.size()) != key.count) {
      fail(node, full, fmt::format("is a list of {}, but must be {}", node.items.size(), wanted(key)));
    }
    std::vector<double> list;
    for (std::size_t n = 0; n < node.items.size(); ++n) {
      list.push_back(quantity(node.items[n], key, fmt::format("{}[{}]", full, n)));
    }
    key.set(scene_, index, list);
  }

  void table(const Node& node, const Key& key, const std::string& full, int index) {
    if (node.kind != Node::Kind::list) fail(node, full, fmt::format("is {}, but must be {}", describe(node), wanted(key)));
    std::vector<double> list;
    for (std::size_t r = 0; r < node.items.size(); ++r) {
      const Node& row = node.items[r];
      const std::string place = fmt::format("{}[{}]", full, r);
      if (row.kind != Node::Kind::list || row.items.size() != key.columns.size()) {
        const std::string given =
            row.kind == Node::Kind::list ? fmt::format("has {}", row.items.size()) : fmt::format("is {}", describe(row));
        fail(row, place,
             fmt::format("{}, but a row needs {} numbers: {}", given, key.columns.size(), fmt::join(key.column_names, ", ")));
      }
      for (std::size_t n = 0; n < row.items.size(); ++n) {
        Key column = key;
        column.dimension = key.columns[n];
        list.push_back(quantity(row.items[n], column, fmt::format("{}[{}]", place, n)));
      }
    }
    key.set(scene_, index, list);
  }

  void integer(const Node& node, const Key& key, const std::string& full, int index) {
    const std::string& text = text_of(node, key, full);
    long n = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc() || end != text.data() + text.size()) {
      fail(node, full, fmt::format("is '{}', but must be {}, {}", text, wanted(key), allowed_values(key)));
    }
    refuse_outside(static_cast<double>(n), node, key, full);
    key.set(scene_, index, n);
  }

  void choice(const Node& node, const Key& key, const std::string& full, int index) {
    const std::string& word = text_of(node, key, full);
    if (std::ranges::count(key.choices, word) == 0) {
      const std::string nearest = nearest_name(word, key.choices);
      fail(node, full,
           fmt::format("is '{}', but must be {}{}", word, wanted(key),
                       nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
    }
    key.set(scene_, index, word);
  }

  void section(const Node& node, const Key& key, const std::string& full, int index) {
    if (node.kind == Node::Kind::text && !key.choices.empty()) return choice(node, key, full, index);
    if (node.kind != Node::Kind::mapping && node.kind != Node::Kind::nothing) {
      fail(node, full, fmt::format("is {}, but must be {}", describe(node), wanted(key)));
    }
    if (key.enter) key.enter(scene_, index);
    mapping(node, key.path, full, index);
  }

  // Names become parts of file names, of engine commands and of --set keys.
  void refuse_bad_name(const std::string& name, const Node& entry, const std::string& full) const {
    const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    if (name.empty() || name.size() > 40 || !std::ranges::all_of(name, plain)) {
      fail(entry, full, fmt::format("has a name that cannot be used: '{}'; use up to 40 letters, digits, _ and -", name));
    }
  }

  // A mapping whose names are the user's.
  void named(const Node& node, const Key& key, const std::string& full, int of) {
    if (node.kind != Node::Kind::mapping && node.kind != Node::Kind::nothing) {
      fail(node, full, fmt::format("is {}, but must be {}", describe(node), wanted(key)));
    }
    for (const auto& [name, entry] : node.entries) {
      const std::string path = joined(full, name);
      refuse_bad_name(name, entry, path);
      if (entry.kind != Node::Kind::mapping) fail(entry, path, fmt::format("is {}, but must be a mapping", describe(entry)));
      const int index = key.append(scene_, of, name);
      scene_.places.note(path, entry.place);
      mapping(entry, key.path + ".*", path, index, &node);
    }
  }

  void list(const Node& node, const Key& key, const std::string& full, int of) {
    if (node.kind != Node::Kind::list && node.kind != Node::Kind::nothing) {
      const char* brackets = node.kind == Node::Kind::mapping ? "; put it in brackets: [{...}]" : "";
      fail(node, full, fmt::format("is {}, but must be {}{}", describe(node), wanted(key), brackets));
    }
    for (std::size_t n = 0; n < node.items.size(); ++n) {
      const Node& item = node.items[n];
      const std::string path = fmt::format("{}[{}]", full, n);
      if (item.kind != Node::Kind::mapping) {
        fail(item, path, fmt::format("is {}, but must be a mapping with {}", describe(item), keys_of(key.path + ".*")));
      }
      const int index = key.append(scene_, of, "");
      scene_.places.note(path, item.place);
      mapping(item, key.path + ".*", path, index);
    }
  }

  Scene& scene_;
  double scale_length_ = 0;
};

}  // namespace

void bind(const Node& document, Scene& scene) {
  if (document.kind != Node::Kind::mapping) {
    throw SceneError(fmt::format("{}: a scene is a mapping of keys, but this is {}", document.place, describe(document)));
  }
  Binder(scene).mapping(document, "", "", 0);
}

}  // namespace couloir
