#include "coupling/cases/case_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {

namespace fs = std::filesystem;

CaseReader::CaseReader(const std::string& file, const CaseChoice& choice)
    : file_(file), folder_((fs::path(".") / fs::path(file).parent_path()).lexically_normal().string()), choice_(choice) {}

void CaseReader::read_top(const CaseFields& top) {
  scene_ = top.text("scene", "scene.yaml");
  const Node* node = top.find("variants");
  if (!node) {
    variants_.emplace_back("", Overrides{});
    return;
  }
  if (node->kind != Node::Kind::mapping || node->entries.empty())
    throw SceneError(
        fmt::format("{}: variants is {}, but must be a mapping from names to overrides", node->place, describe(*node)));
  for (const auto& [name, entry] : node->entries) variants_.emplace_back(name, overrides(entry, "variants." + name));
}

bool CaseReader::wanted(const CaseSetup& setup, const std::string& variant) const {
  return holds(setup.variants, variant) && (choice_.variants.empty() || holds(choice_.variants, variant)) &&
         (setup.quick != "only" || choice_.quick);
}

bool CaseReader::skipped(const CaseSetup& setup, int row) const {
  return choice_.quick && (setup.quick == "skip" || (setup.quick == "rows" && std::ranges::count(setup.quick_rows, row) == 0));
}

Overrides CaseReader::overrides(const Node& node, const std::string& name) const {
  Overrides out;
  if (node.kind == Node::Kind::nothing) return out;
  if (node.kind != Node::Kind::mapping)
    throw SceneError(
        fmt::format("{}: {} is {}, but must be a mapping from the scene's keys to values", node.place, name, describe(node)));
  for (const auto& [key, value] : node.entries) out.emplace_back(key, override_text(value));
  return out;
}

std::vector<std::string> CaseReader::variant_list(const CaseFields& f, const std::string& key) const {
  std::vector<std::string> names, all;
  for (const auto& [name, set] : variants_) all.push_back(name);
  if (!f.find(key)) return all;
  for (const Node& item : f.list(key)) {
    refuse_unknown_variant(item, item.text);
    names.push_back(item.text);
  }
  return names;
}

void CaseReader::refuse_unknown_variant(const Node& at, const std::string& name) const {
  std::vector<std::string> all;
  for (const auto& [known, set] : variants_) all.push_back(known);
  if (holds(all, name)) return;
  const std::string known = all == std::vector<std::string>{""} ? ", which names none" : suggestion(name, all, "there are");
  throw SceneError(fmt::format("{}: '{}' is no variant of this file{}", at.place, name, known));
}

CaseSetup CaseReader::setup(const CaseFields& f, std::size_t rows) const {
  CaseSetup out;
  out.name = f.text("name");
  if (out.name.empty()) f.fail(f.need("name"), "name", "is empty");
  out.scene = (fs::path(folder_) / f.text("scene", scene_)).string();
  out.variants = variant_list(f, "variants");
  if (const Node* set = f.find("set")) out.set = overrides(*set, "set");
  read_quick(f, rows, out);
  if (const Node* search = f.find("search")) out.search = read_search(*search);
  return out;
}

void CaseReader::read_quick(const CaseFields& f, std::size_t rows, CaseSetup& out) const {
  const Node* quick = f.find("quick");
  if (!quick) return;
  if (quick->kind == Node::Kind::mapping) {
    out.quick = "set";
    out.quick_set = overrides(*quick, "quick");
  } else if (quick->kind == Node::Kind::text && (quick->text == "skip" || quick->text == "only")) {
    out.quick = quick->text;
  } else if (quick->kind == Node::Kind::list && !quick->items.empty() && rows > 0) {
    out.quick = "rows";
    for (const Node& item : quick->items) {
      int row = 1;
      while (row <= static_cast<int>(rows) && item.text != std::to_string(row)) ++row;
      if (row > static_cast<int>(rows))
        f.fail(item, "quick", fmt::format("names row {}, but there are {}", describe(item), rows));
      out.quick_rows.push_back(row);
    }
  } else {
    f.fail(*quick, "quick",
           fmt::format("is {}, but must be skip, only, {}a mapping of overrides", describe(*quick),
                       rows > 0 ? "a list of row numbers, or " : "or "));
  }
}

Overrides CaseReader::last_overrides(const CaseSetup& setup) const {
  Overrides out;
  if (choice_.quick) out = setup.quick_set;
  out.insert(out.end(), choice_.set.begin(), choice_.set.end());
  return out;
}

Search CaseReader::read_search(const Node& node) const {
  const CaseFields f(node, "a search", {"key", "value", "from", "to", "step", "quantity", "bound"});
  Search out;
  out.key = f.need("key").text;
  out.form = f.text("value", "{}");
  if (out.form.find("{}") == std::string::npos) f.fail(f.need("value"), "value", "needs {} where the number stands");
  const auto number = [&](const char* name) {
    const auto [value, unit] = parsed(f.need(name), name, parse_case_value);
    if (std::string(name) == "from") out.unit = unit.text;
    if (unit.text != out.unit) f.fail(f.need(name), name, "has another unit than from");
    return value;
  };
  out.from = number("from"), out.to = number("to"), out.step = number("step");
  if (!(out.step > 0) || !(out.to > out.from)) f.fail(f.need("step"), "step", "must be above 0, and from below to");
  out.quantity = f.need("quantity").text;
  std::tie(out.bound, out.bound_unit) = parsed(f.need("bound"), "bound", parse_case_value);
  require_unit(f.need("bound"), "bound", out.quantity, out.bound_unit);
  return out;
}

void CaseReader::require_unit(const Node& at, const std::string& name, const std::string& path, const CaseUnit& unit) const {
  if (path.find(" / ") != std::string::npos || path == "critical") return;
  const std::string wanted = quantity_of_path(path);
  if (wanted.empty() || unit.quantity == wanted || (wanted == "a plain number" && unit.quantity.empty())) return;
  throw SceneError(fmt::format("{}: {} {}, but {}is {}; write {}", at.place, name,
                               unit.text.empty() ? "has no unit" : fmt::format("is in {}", unit.text),
                               name == path ? "" : path + " ", wanted, fmt::join(units_of_quantity(wanted), ", ")));
}

void CaseReader::require_text(const Node& node, const std::string& name) const {
  if (node.kind == Node::Kind::text) return;
  throw SceneError(
      fmt::format("{}: {} is {}, but must be a number, with a unit where it has one", node.place, name, describe(node)));
}

void CaseReader::throw_wrong(const Node& node, const std::string& name, const std::string& what) const {
  throw SceneError(fmt::format("{}: {} {}", node.place, name, what));
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::count(names, name) > 0;
}

std::vector<std::string> find_case_files(const std::vector<std::string>& paths, const std::string& name) {
  std::vector<std::string> found;
  for (const std::string& path : paths) {
    std::error_code error;
    std::vector<std::string> here;
    if (!fs::exists(path, error)) throw SceneError(path + ": there is no such file or folder; give an experiment's folder");
    if (!fs::is_directory(path, error)) {
      here.push_back(path);
    } else if (fs::exists(fs::path(path) / name, error)) {
      here.push_back((fs::path(path) / name).string());
    } else {
      for (const auto& entry : fs::recursive_directory_iterator(path, error))
        if (entry.path().filename() == name) here.push_back(entry.path().string());
      std::ranges::sort(here);
    }
    if (here.empty())
      throw SceneError(fmt::format("{} holds no {}; give an experiment's folder, or a folder of those", path, name));
    for (std::string& file : here)
      if (std::ranges::count(found, file) == 0) found.push_back(std::move(file));
  }
  return found;
}

std::string experiment_name(const std::string& folder) {
  const auto path = fs::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace couloir
