#include "coupling/study/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/cases/scatter.hpp"
#include "coupling/records/provenance.hpp"
#include "coupling/study/ladder_reader.hpp"
#include "coupling/study/likeness.hpp"
#include "coupling/study/study_text.hpp"

namespace couloir {
namespace {

using Json = nlohmann::ordered_json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double or_zero(double value) {
  return std::isnan(value) ? 0 : value;
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

std::vector<std::size_t> done_rows(const Study& study, const std::vector<StudyResult>& results, std::size_t rung) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < study.rows.size(); ++k)
    if (study.rows[k].rung == int(rung) && results[k].status == StudyResult::Status::done) out.push_back(k);
  return out;
}

Scatter values_of(const Study& study, const std::vector<StudyResult>& results, std::size_t rung, std::size_t quantity) {
  std::vector<double> values;
  for (const std::size_t k : done_rows(study, results, rung)) values.push_back(results[k].values[quantity]);
  return scatter_of(values);
}

void mark_front(std::vector<RungFigures>& rungs, const std::vector<RungCost>& costs) {
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    const auto beats = [&](std::size_t n) {
      return rungs[n].error <= rungs[k].error && costs[n].cpu <= costs[k].cpu &&
             (rungs[n].error < rungs[k].error || costs[n].cpu < costs[k].cpu);
    };
    rungs[k].front = !std::isnan(rungs[k].error);
    for (std::size_t n = 0; n < rungs.size(); ++n) rungs[k].front = rungs[k].front && !beats(n);
  }
}

// Whether `fine` has smaller cells or grains in the same mode, and sets nothing else that `coarse` does not. All cells are finer
// than a mass point.
bool finer(const Rung& fine, const Rung& coarse) {
  if (coarse.mode == mass_point_mode) return fine.mode == to_string(Mode::continuum);
  const auto set_too = [&](const auto& one) {
    return is_size(one.first) || std::ranges::find(coarse.set, one) != coarse.set.end();
  };
  const auto count = [](double in_depth) { return std::isnan(in_depth) ? 1 : in_depth; };
  const double cells = count(fine.cells_in_depth) / count(coarse.cells_in_depth),
               grains = count(fine.grains_in_depth) / count(coarse.grains_in_depth);
  constexpr double same = 1 + 1e-9;
  return fine.mode == coarse.mode && std::ranges::all_of(fine.set, set_too) && cells >= 1 / same && grains >= 1 / same &&
         cells * grains > same;
}

// Of each rung to the farthest of the finer ones.
void add_steps(const std::vector<Rung>& rungs, LadderFigures& figures) {
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    double away = 0;
    for (std::size_t n = 0; n < rungs.size(); ++n)
      if (finer(rungs[n], rungs[k])) away = std::fmax(away, std::abs(figures.rungs[n].value - figures.rungs[k].value));
    figures.rungs[k].step = or_zero(away / std::abs(figures.reference));
  }
}

}  // namespace

std::vector<RungCost> rung_costs(const Study& study, const std::vector<StudyResult>& results) {
  std::vector<RungCost> out;
  for (std::size_t r = 0; r < study.ladder->rungs.size(); ++r) {
    RungCost& cost = out.emplace_back();
    for (const std::size_t k : done_rows(study, results, r)) ++cost.packings, cost.cpu += results[k].cpu;
    cost.cpu = cost.packings > 0 ? cost.cpu / cost.packings : nan;
  }
  return out;
}

bool is_size(const std::string& key) {
  return key == "continuum.cell" || key == "grains.diameter";
}

double trusted_bias(const RungFigures& r) {
  return std::isnan(r.bias) ? r.bias : std::max(std::abs(r.bias), r.step);
}

LadderChoice choose(double wanted, const std::vector<RungFigures>& rungs, const std::vector<RungCost>& costs) {
  LadderChoice out{.wanted = wanted};
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    const RungFigures& r = rungs[k];
    const double bias = trusted_bias(r);
    const double left = wanted * wanted - bias * bias;
    if (!(left > 0) && !(left == 0 && r.scatter == 0)) continue;
    const double needed = r.scatter == 0 ? 1 : std::ceil(r.scatter * r.scatter / left * (1 - 1e-12));
    if (!(needed <= most_packings)) continue;
    const int packings = std::max(1, int(needed));
    const double cpu = packings * costs[k].cpu;
    if (out.rung >= 0 && out.cpu <= cpu) continue;
    out.rung = int(k), out.packings = packings, out.cpu = cpu;
    out.error = std::sqrt(bias * bias + r.scatter * r.scatter / packings);
  }
  return out;
}

std::vector<LadderFigures> ladder_figures(const Study& study, const std::vector<StudyResult>& results) {
  const Ladder& ladder = *study.ladder;
  const std::vector<RungCost> costs = rung_costs(study, results);
  std::vector<LadderFigures> out;
  for (std::size_t q = 0; q < ladder.quantities.size(); ++q) {
    LadderFigures& figures = out.emplace_back();
    double doubt = 0;
    if (ladder.reference >= 0) {
      const Scatter s = values_of(study, results, std::size_t(ladder.reference), q);
      figures.reference = s.count > 0 ? s.mean : nan;
      figures.floor = or_zero(s.scatter) / std::abs(figures.reference);
      doubt = figures.floor / std::sqrt(std::max(1, s.count));
    } else {
      figures.reference = ladder.values[q].value;
    }
    for (std::size_t r = 0; r < ladder.rungs.size(); ++r) {
      const Scatter s = values_of(study, results, r, q);
      RungFigures& f = figures.rungs.emplace_back();
      f.value = s.count > 0 ? s.mean : nan;
      f.bias = (f.value - figures.reference) / std::abs(figures.reference);
      f.scatter = s.count > 0 ? or_zero(s.scatter) / std::abs(figures.reference) : nan;
      f.error = std::hypot(f.bias, f.scatter);
      f.doubt = std::hypot(f.scatter / std::sqrt(std::max(1, s.count)), int(r) == ladder.reference ? 0 : doubt);
    }
    add_steps(ladder.rungs, figures);
    mark_front(figures.rungs, costs);
    for (const double wanted : ladder.errors) figures.choices.push_back(choose(wanted, figures.rungs, costs));
  }
  return out;
}

std::string ladder_text(const Study& study, const std::vector<StudyResult>& results) {
  const Ladder& ladder = *study.ladder;
  const std::vector<RungCost> costs = rung_costs(study, results);
  const std::vector<LadderFigures> all = ladder_figures(study, results);
  std::string out;
  for (std::size_t q = 0; q < all.size(); ++q) {
    const LadderFigures& figures = all[q];
    const StudyQuantity& quantity = ladder.quantities[q];
    out += fmt::format("{} against {}: {}{}\n", quantity.path,
                       ladder.reference >= 0 ? ladder.rungs[std::size_t(ladder.reference)].name : ladder.values[q].source,
                       with_unit(figures.reference, quantity.unit),
                       figures.floor > 0 ? fmt::format(", whose packings scatter by {}", percent(figures.floor)) : "");
    std::vector<std::vector<std::string>> table{
        {"", "rung", "value", "error", "bias", "+-", "to finer", "scatter", "packings", "processor time"}};
    for (std::size_t r = 0; r < figures.rungs.size(); ++r) {
      const RungFigures& f = figures.rungs[r];
      table.push_back({f.front ? "*" : "", ladder.rungs[r].name, with_unit(f.value, quantity.unit), percent(f.error),
                       percent(f.bias), percent(f.doubt), f.step > 0 ? percent(f.step) : "", percent(f.scatter),
                       std::to_string(costs[r].packings),
                       std::isnan(costs[r].cpu) ? "-" : fmt::format("{:.3g} s", costs[r].cpu)});
    }
    out += columns_text(table);
    for (const LadderChoice& c : figures.choices) {
      if (c.rung < 0) {
        out += fmt::format("for {}: no rung, not even by the mean of {} packings\n", percent(c.wanted), most_packings);
        continue;
      }
      out += fmt::format("for {}: {}{}, {:.3g} s\n", percent(c.wanted), ladder.rungs[std::size_t(c.rung)].name,
                         c.packings > 1 ? fmt::format(", the mean of {} packings", c.packings) : "", c.cpu);
    }
  }
  return out + "*: no other rung is both cheaper and better; error: bias and scatter of one run\n";
}

Json ladder_json(const Study& study, const std::vector<StudyResult>& results) {
  const Ladder& ladder = *study.ladder;
  const std::vector<RungCost> costs = rung_costs(study, results);
  const std::vector<LadderFigures> all = ladder_figures(study, results);
  Json rungs = Json::array(), quantities = Json::array();
  for (std::size_t r = 0; r < ladder.rungs.size(); ++r) {
    const Rung& rung = ladder.rungs[r];
    Json set = Json::object();
    for (const auto& [key, value] : rung.set) set[key] = value;
    rungs.push_back({{"name", rung.name},
                     {"mode", rung.mode},
                     {"set", set},
                     {"cells_in_depth", number(rung.cells_in_depth)},
                     {"grains_in_depth", number(rung.grains_in_depth)},
                     {"packings", costs[r].packings},
                     {"cpu", number(costs[r].cpu)},
                     {"planned", rung.planned}});
  }
  for (std::size_t q = 0; q < all.size(); ++q) {
    Json figures = Json::array(), choices = Json::array();
    for (const RungFigures& f : all[q].rungs)
      figures.push_back({{"value", number(f.value)},
                         {"bias", number(f.bias)},
                         {"scatter", number(f.scatter)},
                         {"error", number(f.error)},
                         {"doubt", number(f.doubt)},
                         {"step", number(f.step)},
                         {"front", f.front}});
    for (const LadderChoice& c : all[q].choices) {
      if (c.rung < 0)
        choices.push_back({{"wanted", c.wanted}, {"rung", nullptr}});
      else
        choices.push_back({{"wanted", c.wanted},
                           {"rung", ladder.rungs[std::size_t(c.rung)].name},
                           {"packings", c.packings},
                           {"error", c.error},
                           {"cpu", c.cpu}});
    }
    const bool rung = ladder.reference >= 0;
    quantities.push_back({{"quantity", ladder.quantities[q].path},
                          {"unit", ladder.quantities[q].unit.text},
                          {"reference", number(all[q].reference)},
                          {"source", rung ? "rung " + ladder.rungs[std::size_t(ladder.reference)].name : ladder.values[q].source},
                          {"floor", number(all[q].floor)},
                          {"rungs", figures},
                          {"choices", choices}});
  }
  return {{"format", "couloir ladder"},
          {"format_version", 1},
          {"name", study.name},
          {"title", study.title},
          {"revision", provenance().revision},
          {"cpu", provenance().cpu},
          {"scene", likeness_json(ladder.scene)},
          {"rungs", rungs},
          {"quantities", quantities}};
}

}  // namespace couloir
