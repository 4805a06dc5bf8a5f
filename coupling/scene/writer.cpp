// Scene -> YAML, by the schema.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "coupling/scene/reader.hpp"
#include "coupling/scene/schema.hpp"

namespace couloir {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (code < 0x20 || code == 0x7f) {
      out += fmt::format("\\x{:02x}", code);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string written(const Key& key, const Value& value) {
  if (const auto* number = std::get_if<double>(&value))
    return *number == 0 && !key.choices.empty() ? key.choices.front() : exact_quantity(*number, key.dimension);
  if (const auto* number = std::get_if<long>(&value)) return fmt::format("{}", *number);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    std::vector<std::string> items;
    if (key.kind == ValueKind::table) {
      const std::size_t n = key.columns.size();
      for (std::size_t r = 0; r + n <= list->size(); r += n) {
        std::vector<std::string> row;
        for (std::size_t c = 0; c < n; ++c) row.push_back(exact_quantity((*list)[r + c], key.columns[c]));
        items.push_back(fmt::format("[{}]", fmt::join(row, ", ")));
      }
    } else {
      for (const double x : *list) items.push_back(exact_quantity(x, key.dimension));
    }
    return fmt::format("[{}]", fmt::join(items, ", "));
  }
  const auto& text = std::get<std::string>(value);
  // "on" and "off" are truth values to some YAML readers.
  return key.kind == ValueKind::text || text == "on" || text == "off" ? quoted(text) : text;
}

// What an optional key holds where it was not given.
bool is_nothing(const Value& value) {
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    return std::ranges::all_of(*list, [](double x) { return x == 0; });
  return value == Value(0.0) || value == Value(0L) || value == Value("");
}

bool belongs(const Scene& scene, const Key& key, int index) {
  if (key.selector.empty()) return true;
  const Key& selector = schema_key(key.parent() + "." + key.selector);
  return std::ranges::count(key.selected, std::get<std::string>(selector.get(scene, index))) > 0;
}

void write_mapping(std::string& out, const Scene& scene, const std::string& pattern, int index, int depth) {
  const std::string indent(2 * static_cast<std::size_t>(depth), ' ');
  for (const Key* key : children(pattern)) {
    if (!key->written || !belongs(scene, *key, index)) continue;
    if (key->kind == ValueKind::named) {
      const std::vector<Entry> entries = key->entries(scene, index);
      if (entries.empty()) continue;
      out += fmt::format("{}{}:\n", indent, key->name());
      for (const Entry& e : entries) {
        out += fmt::format("{}  {}:\n", indent, quoted(e.name));
        write_mapping(out, scene, key->path + ".*", e.index, depth + 2);
      }
      continue;
    }
    if (key->kind == ValueKind::list) {
      const std::vector<Entry> entries = key->entries(scene, index);
      if (entries.empty()) continue;
      out += fmt::format("{}{}:\n", indent, key->name());
      for (const Entry& e : entries) {
        std::string entry;
        write_mapping(entry, scene, key->path + ".*", e.index, depth + 2);
        entry[indent.size() + 2] = '-';
        out += entry;
      }
      continue;
    }
    const Value value = key->get ? key->get(scene, index) : Value("");
    if (key->kind == ValueKind::mapping && std::get<std::string>(value).empty()) {
      std::string keys;
      write_mapping(keys, scene, key->path, index, depth + 1);
      if (!keys.empty()) out += fmt::format("{}{}:\n{}", indent, key->name(), keys);
      continue;
    }
    if (key->presence == Presence::optional && is_nothing(value)) continue;
    out += fmt::format("{}{}: {}\n", indent, key->name(), written(*key, value));
  }
}

}  // namespace

std::string write_scene(const Scene& scene) {
  std::string out;
  write_mapping(out, scene, "", 0, 0);
  return out;
}

}  // namespace couloir
