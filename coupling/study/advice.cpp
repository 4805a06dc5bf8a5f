#include "coupling/study/advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/cases/case_reader.hpp"
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

KeptLadder read_ladder(const std::string& file) {
  try {
    const auto j = nlohmann::json::parse(read_text(file));
    if (j.at("format") != "couloir ladder" || j.at("format_version") != 1)
      throw SceneError(file + ": is no ladder of this version; couloir study with --keep makes it anew");
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
    return out;
  } catch (const nlohmann::json::exception& error) {
    throw SceneError(
        fmt::format("{}: cannot be read as a ladder: {}; couloir study with --keep makes it anew", file, error.what()));
  }
}

std::size_t quantity_at(const KeptLadder& ladder, const std::string& path) {
  const auto at = std::ranges::find(ladder.quantities, path, &KeptQuantity::path);
  return std::size_t(at - ladder.quantities.begin());
}

// Of a rung's keys those that mean the same in another scene: no lengths, no places.
bool carries_over(const std::string& key, const Scene& scene) {
  const bool of_model = key.starts_with("continuum.") || key.starts_with("grains.");
  for (const char* own : {"continuum.refine", "grains.zone", "grains.seed", "grains.replicates"})
    if (key.starts_with(own)) return false;
  const CaseUnit unit = unit_of_bare(key, scene);
  return of_model && (unit.quantity.empty() || unit.quantity == describe(Dimension::angle));
}

void fit(Advice& advice, const Scene& scene, const std::string& path, const std::string& materials, const Overrides& given) {
  const KeptRung& rung = advice.ladder.rungs[std::size_t(advice.choice.rung)];
  const double there = advice.ladder.costs[std::size_t(advice.choice.rung)].cpu * advice.choice.packings;
  if (rung.mode == mass_point_mode) {
    advice.cost = there;
    return;
  }
  advice.set.emplace_back("mode", rung.mode);
  const double depth = depth_before(scene);
  const auto length = [&](const char* key, double count) {
    if (!std::isnan(count)) advice.set.emplace_back(key, fmt::format("{:.3g} mm", depth / count * 1e3));
  };
  length("continuum.cell", rung.cells_in_depth);
  length("grains.diameter", rung.grains_in_depth);
  for (const auto& [key, value] : rung.set) {
    if (key == "continuum.cell" || key == "grains.diameter") continue;
    if (carries_over(key, scene))
      advice.set.emplace_back(key, value);
    else
      advice.left.push_back(key);
  }
  try {
    Overrides all = given;
    all.insert(all.end(), advice.set.begin(), advice.set.end());
    const double here = make_plan(read_scene(path, materials, all)).time;
    advice.cost = rung.planned > 0 ? there * here / rung.planned : nan;
  } catch (const SceneError& error) {
    advice.cost = nan;
    advice.refusal = error.what();
  }
}

std::string command(const Advice& a, const std::string& path) {
  if (a.set.empty()) return "couloir plan " + path;
  std::string out = "couloir run " + path;
  for (const auto& [key, value] : a.set) out += fmt::format(" --set '{}={}'", key, value);
  if (a.choice.packings > 1) out += fmt::format(" --set grains.replicates={}", a.choice.packings);
  return out;
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
  Advice out;
  out.scene = likeness(scene);
  out.distance = std::numeric_limits<double>::infinity();
  std::vector<std::string> known;
  for (const KeptLadder& ladder : ladders) {
    for (const KeptQuantity& q : ladder.quantities)
      if (!holds(known, q.path)) known.push_back(q.path);
    const std::size_t at = quantity.empty() ? 0 : quantity_at(ladder, quantity);
    const double d = distance(out.scene, ladder.scene);
    if (at >= ladder.quantities.size() || d >= out.distance) continue;
    out.ladder = ladder, out.quantity = at, out.distance = d;
  }
  if (out.ladder.file.empty())
    throw SceneError(fmt::format("--quantity {}: no ladder is of it{}", quantity, suggestion(quantity, known, "there are")));
  out.choice = choose(error, out.ladder.quantities[out.quantity].rungs, out.ladder.costs);
  if (out.choice.rung >= 0) fit(out, scene, path, materials, set);
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
  if (a.choice.rung < 0) {
    const auto least =
        std::ranges::min_element(q.rungs, {}, [](const RungFigures& f) { return std::isnan(f.error) ? 1e300 : f.error; });
    return out + fmt::format("for {}: no rung, not even by the mean of {} packings; the best, {}, is off by {}\n",
                             percent(a.choice.wanted), most_packings, a.ladder.rungs[std::size_t(least - q.rungs.begin())].name,
                             percent(least->error));
  }
  const RungFigures& f = q.rungs[std::size_t(a.choice.rung)];
  out += fmt::format("for {}: {}{}\n", percent(a.choice.wanted), a.ladder.rungs[std::size_t(a.choice.rung)].name,
                     a.choice.packings > 1 ? fmt::format(", the mean of {} packings", a.choice.packings) : "");
  out += fmt::format("  error there: {} (bias {} +- {}, packings scatter by {}); cost there {:.3g} s of processor time\n",
                     percent(a.choice.error), percent(f.bias), percent(f.doubt), percent(f.scatter), a.choice.cpu);
  if (!a.refusal.empty()) return out + fmt::format("  this scene refuses these settings: {}\n", a.refusal);
  out += fmt::format("  here: {:.3g} s{}\n  {}\n", a.cost, a.set.empty() ? "; the plan shows it" : ", by the ratio of the plans",
                     command(a, path));
  if (!a.left.empty()) out += fmt::format("  the rung also sets, for its own scene: {}\n", fmt::join(a.left, ", "));
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
  if (a.choice.rung < 0) return out;
  const RungFigures& f = q.rungs[std::size_t(a.choice.rung)];
  Json set = Json::object();
  for (const auto& [key, value] : a.set) set[key] = value;
  out["rung"] = a.ladder.rungs[std::size_t(a.choice.rung)].name;
  out["packings"] = a.choice.packings;
  out["error"] = a.choice.error;
  out["bias"] = or_null(f.bias), out["doubt"] = or_null(f.doubt), out["scatter"] = or_null(f.scatter);
  out["cpu_there"] = a.choice.cpu;
  out["cpu_here"] = or_null(a.cost);
  out["set"] = set;
  out["left_out"] = a.left;
  out["refusal"] = a.refusal;
  out["command"] = a.refusal.empty() ? command(a, path) : "";
  return out;
}

}  // namespace couloir
