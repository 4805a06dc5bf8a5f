#include "coupling/study/advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <tuple>

#include "coupling/cases/case_reader.hpp"
#include "coupling/cases/for_shell.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/scene/names.hpp"
#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/units.hpp"
#include "coupling/study/ladder_reader.hpp"
#include "coupling/study/study_text.hpp"
#include "coupling/study/study_unit.hpp"

namespace couloir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double number(const nlohmann::json& value) {
  return value.is_null() ? nan : value.get<double>();
}

constexpr const char* anew = "; couloir study with --keep makes it anew";

// Of what a slip of an editor, or half a file, makes of it.
void require_sense(const KeptLadder& ladder) {
  const auto require = [&](bool holds, const char* what) {
    if (!holds) throw SceneError(fmt::format("{}: {}{}", ladder.file, what, anew));
  };
  require(!ladder.rungs.empty(), "has no rungs");
  require(!ladder.quantities.empty(), "has no quantities");
  for (const RungCost& cost : ladder.costs) require(cost.cpu > 0 && cost.packings > 0, "has a rung that cost nothing");
  const Likeness& l = ladder.scene;
  for (const double number : {l.froude, l.depth_over_height, l.depth_over_diameter})
    require(std::isnan(number) || number > 0, "has a scene with a number below 0");
}

KeptLadder read_ladder(const std::string& file) {
  try {
    const auto j = nlohmann::json::parse(read_text(file));
    if (j.at("format") != "couloir ladder" || j.at("format_version") != 1)
      throw SceneError(file + ": is no ladder of this version" + anew);
    KeptLadder out{.file = file, .name = j.at("name"), .scene = likeness_from(j.at("scene"))};
    for (const auto& r : j.at("rungs")) {
      KeptRung& rung = out.rungs.emplace_back();
      rung.name = r.at("name"), rung.mode = r.at("mode");
      for (const auto& [key, value] : r.at("set").items()) rung.set.emplace_back(key, value.get<std::string>());
      rung.cells_in_depth = number(r.at("cells_in_depth")), rung.grains_in_depth = number(r.at("grains_in_depth"));
      rung.planned = r.at("planned");
      out.costs.push_back({r.at("packings").get<int>(), number(r.at("cpu"))});
    }
    for (const auto& q : j.at("quantities")) {
      KeptQuantity& quantity = out.quantities.emplace_back();
      quantity.path = q.at("quantity"), quantity.source = q.at("source"), quantity.floor = number(q.at("floor"));
      for (const auto& f : q.at("rungs"))
        quantity.rungs.push_back({number(f.at("value")), number(f.at("bias")), number(f.at("scatter")), number(f.at("error")),
                                  number(f.at("doubt")), number(f.at("step")), f.at("front").get<bool>()});
      if (quantity.rungs.size() != out.rungs.size()) throw SceneError(file + ": a quantity has other rungs than the ladder");
    }
    require_sense(out);
    return out;
  } catch (const nlohmann::json::exception&) {
    throw SceneError(file + ": cannot be read as a ladder" + anew);
  }
}

// The same of any obstacle, of any gauge: obstacles.*.impulse.
std::string kind_of(const std::string& path) {
  for (const char* list : {"obstacles.", "gauges."}) {
    const std::size_t begin = std::string(list).size(), end = path.find('.', begin);
    if (path.starts_with(list) && end != std::string::npos) return list + ("*" + path.substr(end));
  }
  return path;
}

bool has(const Scene& scene, const std::string& path) {
  return !(path.starts_with("obstacles.") && scene.obstacles.empty()) &&
         !(path.starts_with("gauges.") && scene.record.gauges.empty());
}

// The first that the scene has too, or that is of the kind asked for; their number where there is none.
std::size_t quantity_at(const KeptLadder& ladder, const Scene& scene, const std::string& asked) {
  const auto at = std::ranges::find_if(ladder.quantities, [&](const KeptQuantity& q) {
    return asked.empty() ? has(scene, q.path) : kind_of(q.path) == kind_of(asked);
  });
  return std::size_t(at - ladder.quantities.begin());
}

// A quantity of an obstacle or a gauge that the scene does not have would be answered for another one.
void require_of_scene(const Scene& scene, const std::string& asked) {
  const auto look = [&](const char* list, const auto& items) {
    if (!asked.starts_with(list)) return;
    std::vector<std::string> names;
    for (const auto& item : items) names.push_back(item.name);
    for (const std::string& name : names)
      if (asked.starts_with(list + name + ".")) return;
    const std::string rest = asked.substr(std::string(list).size());
    throw SceneError(fmt::format("--quantity {}: the scene has no such one{}", asked,
                                 names.empty() ? "" : suggestion(rest.substr(0, rest.find('.')), names, "it has")));
  };
  look("obstacles.", scene.obstacles);
  look("gauges.", scene.record.gauges);
}

bool is_of(const KeptLadder& ladder, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path folder = fs::is_directory(path, none) ? fs::path(path) : fs::path(path).parent_path();
  return fs::equivalent(folder.empty() ? "." : folder, fs::path(ladder.file).parent_path(), none);
}

// Whether a rung's key means the same in another scene: no lengths, no places.
bool carries_over(const std::string& key, const Scene& scene) {
  const bool of_model = key.starts_with("continuum.") || key.starts_with("grains.");
  for (const char* own : {"continuum.refine", "grains.zone", "grains.seed", "grains.replicates"})
    if (key.starts_with(own)) return false;
  const CaseUnit unit = unit_of_bare(key, scene);
  return of_model && (unit.quantity.empty() || unit.quantity == describe(Dimension::angle));
}

bool can_be_set(const KeptRung& rung, const Scene& scene) {
  return std::ranges::all_of(rung.set, [&](const auto& one) { return is_size(one.first) || carries_over(one.first, scene); });
}

// Sets what the chosen rung asks for. Returns why the scene does not take it; empty: it does.
std::string fit(Advice& advice, const Scene& scene, const std::string& path, const std::string& materials) {
  const KeptRung& rung = advice.ladder.rungs[std::size_t(advice.choice.rung)];
  const double there = advice.ladder.costs[std::size_t(advice.choice.rung)].cpu * advice.choice.packings;
  if (rung.mode == mass_point_mode) {
    advice.cost = there;
    return "";
  }
  advice.set.emplace_back("mode", rung.mode);
  const double depth = depth_before(scene);
  const auto length = [&](const char* key, double count) {
    if (!std::isnan(count)) advice.set.emplace_back(key, fmt::format("{:.3g} mm", depth / count * 1e3));
  };
  length("continuum.cell", rung.cells_in_depth);
  length("grains.diameter", rung.grains_in_depth);
  for (const auto& [key, value] : rung.set)
    if (!is_size(key)) advice.set.emplace_back(key, value);
  try {
    Overrides all = advice.given;
    all.insert(all.end(), advice.set.begin(), advice.set.end());
    const double here = make_plan(read_scene(path, materials, all)).time;
    advice.cost = rung.planned > 0 ? there * here / rung.planned : nan;
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

std::string command(const Advice& a, const std::string& path) {
  std::string out = (a.set.empty() ? "couloir plan " : "couloir run ") + for_shell(path);
  for (const Overrides& keys : {a.given, a.set})
    for (const auto& [key, value] : keys) out += " --set " + for_shell(key + "=" + value);
  if (a.choice.packings > 1) out += fmt::format(" --set grains.replicates={}", a.choice.packings);
  return out;
}

// The rung that comes nearest by the mean of many packings, and what it is off by; -1: none has the quantity.
std::pair<int, double> nearest(const std::vector<RungFigures>& rungs) {
  std::pair<int, double> best{-1, std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    const double error = std::sqrt(std::pow(trusted_bias(rungs[k]), 2) + std::pow(rungs[k].scatter, 2) / most_packings);
    if (error < best.second) best = {int(k), error};
  }
  return best;
}

}  // namespace

std::vector<KeptLadder> kept_ladders(const std::string& folder) {
  std::vector<KeptLadder> out;
  for (const std::string& file : find_case_files({folder}, "ladder.json")) out.push_back(read_ladder(file));
  return out;
}

Advice advise(const std::string& path, const std::string& materials, const Overrides& set, double error,
              const std::string& quantity, const std::vector<KeptLadder>& ladders) {
  const Scene scene = read_scene(path, materials, set);
  require_of_scene(scene, quantity);
  Advice out;
  out.given = set;
  out.scene = likeness(scene);
  out.distance = std::numeric_limits<double>::infinity();
  std::vector<std::string> known;
  for (const KeptLadder& ladder : ladders) {
    for (const KeptQuantity& q : ladder.quantities)
      if (!holds(known, q.path)) known.push_back(q.path);
    const std::size_t at = quantity_at(ladder, scene, quantity);
    const double d = distance(out.scene, ladder.scene);
    if (at >= ladder.quantities.size() || d >= out.distance) continue;
    out.ladder = ladder, out.quantity = at, out.distance = d;
  }
  if (out.ladder.file.empty() && quantity.empty())
    throw SceneError(path +
                     ": no ladder has a quantity of a scene without obstacles and gauges; give --quantity, or make a ladder");
  if (out.ladder.file.empty())
    throw SceneError(fmt::format("--quantity {}: no ladder is of it{}", quantity, suggestion(quantity, known, "there are")));
  std::vector<RungFigures> rungs = out.ladder.quantities[out.quantity].rungs;
  const bool own = is_of(out.ladder, path);
  for (std::size_t k = 0; k < rungs.size(); ++k)
    if (!own && !can_be_set(out.ladder.rungs[k], scene)) rungs[k].bias = nan;
  for (;;) {
    out.choice = choose(error, rungs, out.ladder.costs);
    if (out.choice.rung < 0) break;
    out.set.clear();
    const std::string why = fit(out, scene, path, materials);
    if (why.empty()) return out;
    out.refused.push_back(out.ladder.rungs[std::size_t(out.choice.rung)].name + ": " + why);
    rungs[std::size_t(out.choice.rung)].bias = nan;
  }
  out.set.clear();
  std::tie(out.nearest, out.nearest_error) = nearest(rungs);
  return out;
}

const char* trust(double distance) {
  return distance < 0.5 ? "much like this scene" : distance < 1.5 ? "somewhat like this scene" : "unlike this scene: a guess";
}

std::string advice_text(const Advice& a, const std::string& path) {
  const KeptQuantity& q = a.ladder.quantities[a.quantity];
  std::string out = fmt::format("this scene: {}\nnearest ladder: {}: {}\n  distance {:.2g}, {}\n", likeness_text(a.scene),
                                a.ladder.file, likeness_text(a.ladder.scene), a.distance, trust(a.distance));
  out += fmt::format("{}, against {}{}\n", q.path, q.source,
                     q.floor > 0 ? fmt::format(", whose packings scatter by {}", percent(q.floor)) : "");
  for (const std::string& rung : a.refused) out += fmt::format("  this scene refuses {}\n", rung);
  if (a.choice.rung < 0) {
    out += fmt::format("for {}: no rung, not even by the mean of {} packings", percent(a.choice.wanted), most_packings);
    if (a.nearest >= 0)
      out += fmt::format("; the best, {}, is off by {}", a.ladder.rungs[std::size_t(a.nearest)].name, percent(a.nearest_error));
    return out + "\n";
  }
  const RungFigures& f = q.rungs[std::size_t(a.choice.rung)];
  out += fmt::format("for {}: {}{}\n", percent(a.choice.wanted), a.ladder.rungs[std::size_t(a.choice.rung)].name,
                     a.choice.packings > 1 ? fmt::format(", the mean of {} packings", a.choice.packings) : "");
  out += fmt::format("  error there: {} (bias {} +- {}{}, packings scatter by {}); cost there {:.3g} s of processor time\n",
                     percent(a.choice.error), percent(f.bias), percent(f.doubt),
                     f.step > std::abs(f.bias) ? fmt::format(", finer ones differ by {}", percent(f.step)) : "",
                     percent(f.scatter), a.choice.cpu);
  out += fmt::format("  here: {:.3g} s{}\n  {}\n", a.cost, a.set.empty() ? "; the plan shows it" : ", by the ratio of the plans",
                     command(a, path));
  return out;
}

nlohmann::ordered_json advice_json(const Advice& a, const std::string& path) {
  using Json = nlohmann::ordered_json;
  const KeptQuantity& q = a.ladder.quantities[a.quantity];
  const auto or_null = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  Json out{{"scene", likeness_json(a.scene)},
           {"ladder", {{"file", a.ladder.file}, {"name", a.ladder.name}, {"scene", likeness_json(a.ladder.scene)}}},
           {"distance", a.distance},
           {"trust", trust(a.distance)},
           {"quantity", q.path},
           {"reference", q.source},
           {"floor", or_null(q.floor)},
           {"wanted", a.choice.wanted},
           {"rung", nullptr}};
  out["refused"] = a.refused;
  if (a.choice.rung < 0) return out;
  const RungFigures& f = q.rungs[std::size_t(a.choice.rung)];
  Json set = Json::object();
  for (const auto& [key, value] : a.set) set[key] = value;
  out["rung"] = a.ladder.rungs[std::size_t(a.choice.rung)].name;
  out["packings"] = a.choice.packings;
  out["error"] = a.choice.error;
  out["bias"] = or_null(f.bias), out["to_finer"] = f.step, out["doubt"] = or_null(f.doubt), out["scatter"] = or_null(f.scatter);
  out["cpu_there"] = a.choice.cpu;
  out["cpu_here"] = or_null(a.cost);
  out["set"] = set;
  out["command"] = command(a, path);
  return out;
}

}  // namespace couloir
