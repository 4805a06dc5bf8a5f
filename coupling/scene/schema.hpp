#pragma once
// Every key of a scene file, once: path, kind, dimension, bounds, choices, help, and the member of Scene it stands for.
// Reading, writing, messages and the reference page all come from this table. Defaults are those of scene.hpp.

#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "coupling/scene/scene.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {

enum class ValueKind {
  number,   // with a dimension; or, if `choices` has a word, that instead of 0
  numbers,  // a list of `count` numbers
  table,    // a list of rows, each a list of numbers of the dimensions in `columns`
  integer,
  text,
  choice,   // one of `choices`
  mapping,  // further keys; or, if `choices` are given, one of these words instead
  named,    // a mapping from names that the user chooses to mappings; "*" in paths
  list,     // a list of mappings; "*" in paths, [0], [1], ... in messages
};

using Value = std::variant<double, long, std::string, std::vector<double>>;  // a table: row by row

struct Bounds {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above = false;  // least itself is not allowed
};

enum class Presence {
  required,
  defaulted,  // scene.hpp has a value that means something
  optional,   // may be missing, has no default; written only where it is not 0
};

// Of a named mapping, or of a list, whose entries have no names.
struct Entry {
  std::string name;
  int index = 0;
};

struct Key {
  std::string path;  // "terrain.angle", "obstacles.*.size"
  ValueKind kind = ValueKind::number;
  std::string help;
  Dimension dimension = Dimension::none;
  int count = 1;
  std::vector<Dimension> columns;         // of a table
  std::vector<std::string> column_names;  // as messages call them
  Bounds bounds;
  std::vector<std::string> choices;
  Presence presence = Presence::defaulted;
  std::string selector;               // this key belongs only where its sibling of this name ...
  std::vector<std::string> selected;  // ... is one of these
  bool written = true;                // by write_scene
  bool scaled = true;                 // bare numbers are multiples of the scene's scales, where it has some

  // `index` counts the entries of the innermost named mapping or list (obstacles, gauges), over all that hold such; 0 elsewhere.
  // A mapping's value is the word given instead of it, or empty. No accessors: the reader's own (scales).
  std::function<Value(const Scene&, int index)> get;
  std::function<void(Scene&, int index, const Value&)> set;
  std::function<void(Scene&, int index)> enter;  // when a mapping is opened
  // A named mapping or a list within entry `of` of the one around it: its entries; a new one of this name, and its index.
  std::function<std::vector<Entry>(const Scene&, int of)> entries;
  std::function<int(Scene&, int of, const std::string& name)> append;

  std::string parent() const;  // "terrain"; empty for a key of the file itself
  std::string name() const;    // "angle"
};

const std::vector<Key>& schema();
// The keys right under a mapping's path, in the order in which they are read.
std::vector<const Key*> children(const std::string& parent);
const Key& schema_key(const std::string& path);  // throws std::out_of_range

// "chute, incline" or "from 0 to 0.5" or "above 0 m"; empty: any.
std::string allowed_values(const Key&);

// The reference page, docs/scene.md: every key with its kind, default, bounds and help.
std::string scene_reference();

}  // namespace couloir
