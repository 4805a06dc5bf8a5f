// A plan as text and as JSON.

#include <fmt/format.h>

#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/plan/plan.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

std::string seconds(double value) {
  if (value < 120) return fmt::format("{:.2g} s", value);
  if (value < 7200) return fmt::format("{:.0f} min", value / 60);
  return fmt::format("{:.1f} h", value / 3600);
}

// One line for each size of cells that is there.
std::string levels_text(const Plan& plan) {
  std::string out;
  const char* what = plan.scheme == "noc" ? "grid" : "block";
  for (const LevelCells& l : plan.levels) {
    if (l.cells == 0) continue;
    out += fmt::format("           level {}: {} cells of {}, {} {}{}\n", l.level, l.cells, len(l.cell), l.blocks, what,
                       l.blocks == 1 ? "" : "s");
  }
  if (plan.followed_levels > 0) {
    out += fmt::format("           more where the flow asks, down to {}: about {} cells in all\n",
                       len(std::ldexp(plan.grid.dx, -plan.followed_levels)), plan.followed_cells);
  }
  return out;
}

nlohmann::json json_of(const ZoneBox& box) {
  return {{"x", {box.x0, box.x1}}, {"y", {box.y0, box.y1}}};
}

}  // namespace

namespace {

std::string growth_text(const PlannedZone& zone, const Grid& grid) {
  const ZoneLines& l = zone.lines;
  const ZoneBox widest = box_of({l.x.front(), l.x.back(), l.y.front(), l.y.back()}, grid);
  if (l.x.size() + l.y.size() == 4) return "";
  return fmt::format("grows where a jump nears a face, to x {} to {}, y {} to {} at most; ends when all is at rest or gone",
                     len(widest.x0), len(widest.x1), len(widest.y0), len(widest.y1));
}

// By a mass point; nothing is solved.
std::string estimate_text(const Plan& plan) {
  std::vector<std::string> lines;
  for (const ImpactEstimate& i : plan.impacts)
    lines.push_back(fmt::format("{}: front after {:.3g} s; {:.3g} m/s, {:.3g} mm deep, {:.3g} N ({:.3g} N of it hydrostatic)",
                                i.obstacle, i.arrival, i.velocity, i.depth * 1e3, i.force(), i.hydrostatic));
  if (!std::isnan(plan.run_out)) lines.push_back(fmt::format("the middle of the flow stops at x {:.3g} m", plan.run_out));
  if (lines.empty()) return "";
  lines.emplace_back(
      "a mass point and rho u^2 h b, nothing solved: times and speeds within a half, forces within a factor of three");
  std::string out;
  for (const std::string& line : lines) out += fmt::format("{:<10} {}\n", &line == &lines.front() ? "estimate" : "", line);
  return out;
}

}  // namespace

std::string plan_text(const Plan& plan) {
  std::string out;
  if (!plan.title.empty()) out += plan.title + "\n";
  out += fmt::format("mode       {}\n", to_string(plan.mode));
  out += fmt::format("release    {:.4g} kg, {:.4g} L\n", plan.release_mass, plan.release_volume * 1e3);
  if (plan.cells > 0) {
    out += fmt::format("mesh       {} x {} cells of {} x {}\n", plan.grid.nx, plan.grid.ny, len(plan.grid.dx), len(plan.grid.dy));
    out += levels_text(plan);
    out += fmt::format("scheme     {}, limiter {}; instructions {}\n", plan.scheme, plan.limiter, plan.instruction_set);
    out += fmt::format("steps      about {} of {:.2g} ms\n", plan.steps, plan.dt * 1e3);
  }
  out += estimate_text(plan);
  for (const ShallowVerdict& v : plan.shallow)
    out += fmt::format("{:<10} {}\n", &v == &plan.shallow.front() ? "shallow" : "", v.sentence());
  for (const PlannedZone& zone : plan.zones) {
    const ZoneBox& z = zone.box;
    out += fmt::format("zone       x {} to {}, y {} to {} ({} x {} cells)\n", len(z.x0), len(z.x1), len(z.y0), len(z.y1),
                       zone.cells.i1 - zone.cells.i0, zone.cells.j1 - zone.cells.j0);
    out += fmt::format("           {}\n", zone.reason);
    if (const std::string grows = growth_text(zone, plan.grid); !grows.empty()) out += fmt::format("           {}\n", grows);
  }
  if (plan.engine_dt > 0) {
    out += fmt::format("grains     about {} at once; {} engine steps of {:.3g} us\n",
                       plan.grains[static_cast<std::size_t>(plan.mode)], plan.engine_steps, plan.engine_dt * 1e6);
    out += fmt::format(
        "           of {:g} MPa: in a bunch at the expected {:.3g} m/s they overlap by about {:.2g} of their diameter\n",
        plan.youngs_modulus * 1e-6, plan.impact_speed, plan.bunch_overlap);
  }
  for (const std::string& gauge : plan.stress_gauges) out += "gauge      " + gauge + "\n";
  out += fmt::format("cost       about {} (continuum {}, engine {}), {:.0f} MB; within a factor of {}\n", seconds(plan.time),
                     seconds(plan.time_continuum), seconds(plan.time_engine), plan.memory * 1e-6,
                     plan.followed_levels > 0 ? "ten: the mesh follows the flow" : "three");
  if (plan.time < 3) out += "           and up to a second to start the run and to write it\n";
  if (plan.replicates > 1)
    out += fmt::format("           for each of {} packings: {} of one core in all\n", plan.replicates,
                       seconds(plan.replicates * plan.time));
  for (const bool on : {true, false}) {
    out += on ? "effects\n" : "left out\n";
    for (const Effect& effect : plan.effects) {
      if (effect.on == on) out += fmt::format("  {:<20} {}\n", effect.name, effect.reason);
    }
  }
  for (const std::string& warning : plan.warnings) out += "warning    " + warning + "\n";
  return out;
}

nlohmann::json plan_json(const Plan& plan) {
  nlohmann::json json;
  json["title"] = plan.title;
  json["mode"] = to_string(plan.mode);
  json["release"] = {{"volume", plan.release_volume}, {"mass", plan.release_mass}};
  json["continuum"] = {{"scheme", plan.scheme}, {"limiter", plan.limiter}, {"instruction_set", plan.instruction_set},
                       {"cells", plan.cells},   {"nx", plan.grid.nx},      {"ny", plan.grid.ny},
                       {"dx", plan.grid.dx},    {"dy", plan.grid.dy},      {"dt", plan.dt},
                       {"steps", plan.steps}};
  json["continuum"]["levels"] = nlohmann::json::array();
  for (const LevelCells& l : plan.levels) {
    json["continuum"]["levels"].push_back({{"level", l.level}, {"cell", l.cell}, {"blocks", l.blocks}, {"cells", l.cells}});
  }
  json["shallow"] = nlohmann::json::array();
  for (const ShallowVerdict& v : plan.shallow) {
    json["shallow"].push_back({{"place", v.place}, {"obstacle", v.obstacle}, {"holds", v.holds()}, {"sentence", v.sentence()}});
    for (const ShallowTest& t : v.tests)
      json["shallow"].back()["tests"].push_back({{"name", t.name}, {"value", t.value}, {"limit", t.limit}, {"holds", t.holds}});
  }
  json["zones"] = nlohmann::json::array();
  for (const PlannedZone& zone : plan.zones) {
    json["zones"].push_back(json_of(zone.box));
    json["zones"].back()["reason"] = zone.reason;
  }
  json["zone"] = plan.zones.empty() ? nlohmann::json(nullptr) : json["zones"].front();
  json["grains"] = {{"continuum", plan.grains[0]}, {"coupled", plan.grains[1]}, {"grains", plan.grains[2]}};
  json["engine"] = {{"timestep", plan.engine_dt}, {"steps", plan.engine_steps}, {"youngs_modulus", plan.youngs_modulus}};
  json["flow"] = {{"x", plan.at_obstacle.x},
                  {"time", plan.at_obstacle.time},
                  {"depth", plan.at_obstacle.depth},
                  {"velocity", plan.at_obstacle.velocity},
                  {"froude", plan.at_obstacle.froude}};
  json["estimate"] = {{"run_out", std::isnan(plan.run_out) ? nlohmann::json() : nlohmann::json(plan.run_out)},
                      {"obstacles", nlohmann::json::object()}};
  for (const ImpactEstimate& i : plan.impacts) {
    json["estimate"]["obstacles"][i.obstacle] = {{"arrival", i.arrival},       {"velocity", i.velocity},
                                                 {"depth", i.depth},           {"force", i.force()},
                                                 {"force_dynamic", i.dynamic}, {"force_hydrostatic", i.hydrostatic}};
  }
  json["memory"] = plan.memory;
  json["replicates"] = plan.replicates;
  json["time"] = {{"continuum", plan.time_continuum}, {"engine", plan.time_engine}, {"total", plan.time}};
  json["effects"] = nlohmann::json::array();
  for (const Effect& effect : plan.effects) {
    json["effects"].push_back({{"name", effect.name}, {"on", effect.on}, {"reason", effect.reason}});
  }
  json["stress_gauges"] = plan.stress_gauges;
  json["warnings"] = plan.warnings;
  return json;
}

}  // namespace couloir
