#include "coupling/records/compare.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <ranges>

#include "coupling/records/columns.hpp"

namespace couloir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof(double)) == 0;
}

std::string difference(const std::string& name, const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    if (!same_bits(a[k], b[k])) return fmt::format("{} row {}: {:.17g} and {:.17g}", name, k, a[k], b[k]);
  if (a.size() != b.size()) return fmt::format("{}: {} rows and {} rows", name, a.size(), b.size());
  return {};
}

// Columns that make one quantity, such as the components of a force.
struct Group {
  const char *name, *unit;  // "force on {}"; empty: too fine to be told by windows
  std::vector<const char*> columns;
};

// Series that a record has by name.
struct Family {
  const char *folder, *told;
  std::function<std::vector<std::string>(const RecordsReader&)> names;
  std::function<std::vector<double>(const RecordsReader&, const std::string& name, const std::string& column)> read;
  std::vector<Group> groups;
};

std::vector<std::string> measure_names(const RecordsReader& r) {
  std::vector<std::string> out;
  for (const ForceMeasure& m : r.measures()) out.push_back(m.kind + "/" + m.of);
  return out;
}

std::vector<double> read_measure(const RecordsReader& r, const std::string& name, const std::string& column) {
  const auto bar = name.find('/');
  return r.measure({name.substr(bar + 1), name.substr(0, bar)}, column);
}

const std::vector<Family>& families() {
  using R = const RecordsReader&;
  using Text = const std::string&;
  static const std::vector<Family> all{
      {"forces",
       "obstacles",
       [](R r) { return r.obstacles(); },
       [](R r, Text n, Text c) { return r.force(n, c); },
       {{"force on {}", "N", {"fx", "fy", "fz"}}, {"depth on top of {}", "m", {"depth_on_top"}}}},
      {"force_samples",
       "obstacles",
       [](R r) { return r.obstacles(); },
       [](R r, Text n, Text) { return r.force_samples(n); },
       {{"", "", {"fx"}}}},
      {"planes",
       "obstacles of method planes",
       [](R r) { return r.planes(); },
       [](R r, Text n, Text c) { return r.planes(n, c); },
       {{"overflow of {}", "kg", {"overflow"}}, {"depth before {}", "m", {"heap", "climbed"}}}},
      {"gauges",
       "gauges",
       [](R r) { return r.gauges(); },
       [](R r, Text n, Text c) { return r.gauge(n, c); },
       {{"depth at {}", "m", {"depth"}}, {"velocity at {}", "m/s", {"velocity_along", "velocity_across"}}}},
      {"stresses",
       "stress gauges",
       [](R r) { return r.stress_gauges(); },
       [](R r, Text n, Text c) { return r.stress(n, c); },
       {{"stress at {}", "Pa", {"normal", "up", "across"}}}},
      {"measures", "measures of force", measure_names, read_measure, {{"force by {}", "N", {"fx", "fy"}}}}};
  return all;
}

// Takes columns of both runs, row by row.
class Worst {
 public:
  Worst(std::string name, std::string unit) { out_.name = std::move(name), out_.unit = std::move(unit); }
  void add(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& times) {
    const std::size_t rows = std::min(a.size(), b.size());
    if (a.size() != b.size()) out_.same_bits = false;
    for (std::size_t k = 0; k < rows; ++k) {
      out_.same_bits = out_.same_bits && same_bits(a[k], b[k]);
      if (std::isfinite(a[k]) && std::isfinite(b[k])) out_.scale = std::max({out_.scale, std::abs(a[k]), std::abs(b[k])});
      const double d = same_bits(a[k], b[k]) ? 0 : std::abs(a[k] - b[k]);
      if (d <= out_.largest || std::isnan(out_.largest)) continue;
      out_.largest = d;
      out_.time = k < times.size() ? times[k] : nan;
    }
  }
  QuantityDifference taken(bool overall = false) {
    out_.overall = overall;
    return out_;
  }
  void scale_by(double scale) { out_.scale = scale; }
  void missing() { out_.largest = nan, out_.same_bits = false; }

 private:
  QuantityDifference out_;
};

std::string filled(std::string name, const std::string& of) {
  return name.replace(name.find("{}"), 2, of);
}

double impulse(const RecordsReader& run, const std::string& obstacle) {
  const std::vector<double> force = run.force(obstacle, "fx"), length = run.window("length");
  double sum = 0;
  for (std::size_t k = 0; k < std::min(force.size(), length.size()); ++k) sum += force[k] * length[k];
  return sum;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

QuantityDifference ledger(const RecordsReader& a, const RecordsReader& b, const std::string& of, const std::string& unit,
                          const std::vector<std::string>& sizes) {
  Worst worst(of + " ledger", unit);
  const std::vector<double> times = a.window("time");
  double scale = 0;
  for (const WindowColumn& c : window_columns()) {
    const std::string name = c.name;
    if (!name.starts_with(of + "_") || unit != c.unit) continue;
    worst.add(a.window(name), b.window(name), times);
    if (!holds(sizes, name)) continue;
    for (const RecordsReader* run : {&a, &b})
      for (const double size : run->window(name)) scale = std::max(scale, std::abs(size));
  }
  worst.scale_by(scale);
  return worst.taken(of == "mass");
}

// The last field that both have: its worst cell, and how much of the volume lies elsewhere.
void add_depths(const RecordsReader& a, const RecordsReader& b, std::vector<QuantityDifference>& out) {
  const std::vector<long> others = b.frames();
  for (const long k : a.frames() | std::views::reverse) {
    if (std::ranges::find(others, k) == others.end()) continue;
    const Frame p = a.frame(k), q = b.frame(k);
    if (p.h.empty() && q.h.empty()) return;
    Worst depth("final depth", "m");
    if (p.h.size() != q.h.size()) {
      depth.missing();
      out.push_back(depth.taken(true));
      return;
    }
    depth.add(p.h, q.h, std::vector<double>(p.h.size(), p.time));
    out.push_back(depth.taken());
    QuantityDifference elsewhere{.name = "final volume that lies elsewhere", .unit = "1", .time = p.time, .overall = true};
    for (std::size_t c = 0; c < p.h.size(); ++c) {
      elsewhere.largest += std::abs(p.h[c] - q.h[c]) / 2;
      elsewhere.scale += (p.h[c] + q.h[c]) / 2;
      elsewhere.same_bits = elsewhere.same_bits && same_bits(p.h[c], q.h[c]);
    }
    if (elsewhere.scale > 0) elsewhere.largest /= elsewhere.scale, elsewhere.scale = 1;
    out.push_back(elsewhere);
    return;
  }
}

std::string maker_text(const RecordsReader& run, const std::string& attribute) {
  if (!run.has(attribute)) return "";
  return attribute == "threads" || attribute == "ranks" ? fmt::format("{:.0f}", run.number(attribute)) : run.text(attribute);
}

}  // namespace

std::string first_difference(const RecordsReader& a, const RecordsReader& b) {
  for (const WindowColumn& c : window_columns()) {
    const std::string text = difference(std::string("windows/") + c.name, a.window(c.name), b.window(c.name));
    if (!text.empty()) return text;
  }
  for (const Family& family : families()) {
    const std::vector<std::string> names = family.names(a);
    if (names != family.names(b)) return fmt::format("the {} are not the same", family.told);
    for (const std::string& name : names)
      for (const Group& group : family.groups)
        for (const char* column : group.columns) {
          const std::string place = fmt::format("{}/{}/{}", family.folder, name, column);
          const std::string text = difference(place, family.read(a, name, column), family.read(b, name, column));
          if (!text.empty()) return text;
        }
  }
  std::vector<double> when[2];
  for (const Event& event : a.events()) when[0].push_back(event.time);
  for (const Event& event : b.events()) when[1].push_back(event.time);
  if (const std::string text = difference("events/time", when[0], when[1]); !text.empty()) return text;
  if (a.frames() != b.frames()) return fmt::format("frames: {} and {}", a.frames().size(), b.frames().size());
  for (const long k : a.frames()) {
    const Frame p = a.frame(k), q = b.frame(k);
    const std::string at = fmt::format("frames/{:06d}/", k);
    if (p.blocks.places != q.blocks.places) return at + "blocks: the refined cells are not in the same places";
    for (const auto& [name, x, y] : {std::tuple{"h", &p.h, &q.h},
                                     {"hu", &p.hu, &q.hu},
                                     {"hv", &p.hv, &q.hv},
                                     {"blocks/h", &p.blocks.h, &q.blocks.h},
                                     {"blocks/hu", &p.blocks.hu, &q.blocks.hu},
                                     {"blocks/hv", &p.blocks.hv, &q.blocks.hv},
                                     {"grains/x", &p.grains.x, &q.grains.x},
                                     {"grains/vx", &p.grains.vx, &q.grains.vx}}) {
      const std::string text = difference(at + name, *x, *y);
      if (!text.empty()) return text;
    }
    if (!(p == q)) return at + ": the grains are not the same";
  }
  return {};
}

double QuantityDifference::relative() const {
  return largest == 0 ? 0 : scale > 0 ? largest / scale : std::numeric_limits<double>::infinity();
}

std::vector<QuantityDifference> differences(const RecordsReader& a, const RecordsReader& b) {
  std::vector<QuantityDifference> out;
  const std::vector<double> times = a.window("time");
  for (const Family& family : families()) {
    const std::vector<std::string> others = family.names(b);
    for (const std::string& name : family.names(a))
      for (const Group& group : family.groups) {
        if (*group.name == '\0') continue;
        Worst worst(filled(group.name, name), group.unit);
        for (const char* column : group.columns) {
          if (holds(others, name))
            worst.add(family.read(a, name, column), family.read(b, name, column), times);
          else
            worst.missing();
        }
        out.push_back(worst.taken());
      }
  }
  const std::vector<std::string> others = b.obstacles();
  for (const std::string& name : a.obstacles()) {
    if (!holds(others, name)) continue;
    Worst worst("impulse on " + name, "N s");
    worst.add({impulse(a, name)}, {impulse(b, name)}, {});
    out.push_back(worst.taken(true));
  }
  add_depths(a, b, out);
  out.push_back(ledger(a, b, "mass", "kg", {"mass_initial", "mass_entered"}));
  out.push_back(ledger(a, b, "momentum", "N s", {"momentum_scale"}));
  return out;
}

std::vector<Maker> makers(const RecordsReader& a, const RecordsReader& b) {
  static const std::pair<const char*, const char*> attributes[] = {{"couloir_version", "couloir"},
                                                                   {"git_revision", "git revision"},
                                                                   {"build", "build"},
                                                                   {"compiler", "compiler"},
                                                                   {"compiler_flags", "flags"},
                                                                   {"libraries", "libraries"},
                                                                   {"engine", "grain engine"},
                                                                   {"cpu", "CPU"},
                                                                   {"instruction_set", "instruction set"},
                                                                   {"threads", "threads"},
                                                                   {"ranks", "ranks"}};
  std::vector<Maker> out;
  for (const auto& [attribute, what] : attributes) {
    const std::string name = attribute;
    out.push_back({what, maker_text(a, name), maker_text(b, name), name != "threads" && name != "ranks"});
  }
  return out;
}

bool same_makers(const std::vector<Maker>& all) {
  return std::ranges::all_of(all, [](const Maker& m) { return !m.matters || m.first == m.second; });
}

}  // namespace couloir
