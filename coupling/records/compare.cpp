#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "coupling/records/columns.hpp"
#include "coupling/records/reader.hpp"

namespace couloir {
namespace {

std::string difference(const std::string& name, const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    if (std::memcmp(&a[k], &b[k], sizeof(double)) != 0) return fmt::format("{} row {}: {:.17g} and {:.17g}", name, k, a[k], b[k]);
  if (a.size() != b.size()) return fmt::format("{}: {} rows and {} rows", name, a.size(), b.size());
  return {};
}

double impulse(const RecordsReader& run, const std::string& obstacle) {
  const std::vector<double> force = run.force(obstacle, "fx"), length = run.window("length");
  double sum = 0;
  for (std::size_t k = 0; k < std::min(force.size(), length.size()); ++k) sum += force[k] * length[k];
  return sum;
}

}  // namespace

std::string first_difference(const RecordsReader& a, const RecordsReader& b) {
  for (const WindowColumn& c : window_columns()) {
    const std::string text = difference(std::string("windows/") + c.name, a.window(c.name), b.window(c.name));
    if (!text.empty()) return text;
  }
  if (a.obstacles() != b.obstacles()) return "the obstacles are not the same";
  for (const std::string& name : a.obstacles())
    for (const char* column : {"fx", "fy", "fz", "depth_on_top"}) {
      const std::string text = difference("forces/" + name + "/" + column, a.force(name, column), b.force(name, column));
      if (!text.empty()) return text;
    }
  for (const std::string& name : a.obstacles()) {
    const std::string text = difference("force_samples/" + name + "/fx", a.force_samples(name), b.force_samples(name));
    if (!text.empty()) return text;
  }
  if (a.planes() != b.planes()) return "the obstacles of method planes are not the same";
  for (const std::string& name : a.planes())
    for (const char* column : {"overflow", "heap", "climbed"}) {
      const std::string text = difference("planes/" + name + "/" + column, a.planes(name, column), b.planes(name, column));
      if (!text.empty()) return text;
    }
  if (a.gauges() != b.gauges()) return "the gauges are not the same";
  for (const std::string& name : a.gauges())
    for (const char* column : {"depth", "velocity_along", "velocity_across"}) {
      const std::string text = difference("gauges/" + name + "/" + column, a.gauge(name, column), b.gauge(name, column));
      if (!text.empty()) return text;
    }
  if (a.stress_gauges() != b.stress_gauges()) return "the stress gauges are not the same";
  for (const std::string& name : a.stress_gauges())
    for (const char* column : {"normal", "up", "across"}) {
      const std::string text = difference("stresses/" + name + "/" + column, a.stress(name, column), b.stress(name, column));
      if (!text.empty()) return text;
    }
  const auto same = [](const ForceMeasure& p, const ForceMeasure& q) { return p.kind == q.kind && p.of == q.of; };
  const std::vector<ForceMeasure> measures = a.measures(), others = b.measures();
  if (!std::ranges::equal(measures, others, same)) return "the measures of force are not the same";
  for (const ForceMeasure& m : measures)
    for (const char* column : {"fx", "fy"}) {
      const std::string text =
          difference("measures/" + m.kind + "/" + m.of + "/" + column, a.measure(m, column), b.measure(m, column));
      if (!text.empty()) return text;
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

RunDistance distance(const RecordsReader& a, const RecordsReader& b) {
  RunDistance out;
  const std::vector<long> others = b.frames();
  double deepest = 0;
  for (const long k : a.frames()) {
    if (std::find(others.begin(), others.end(), k) == others.end()) continue;
    const Frame p = a.frame(k), q = b.frame(k);
    if (p.h.size() != q.h.size()) continue;
    ++out.common_frames;
    for (std::size_t c = 0; c < p.h.size(); ++c) {
      deepest = std::max({deepest, p.h[c], q.h[c]});
      out.depth = std::max(out.depth, std::abs(p.h[c] - q.h[c]));
    }
  }
  if (deepest > 0) out.depth /= deepest;
  const std::vector<std::string> names = b.obstacles();
  for (const std::string& name : a.obstacles()) {
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    const double p = impulse(a, name), q = impulse(b, name), larger = std::max(std::abs(p), std::abs(q));
    if (larger > 0) out.impulse = std::max(out.impulse, std::abs(p - q) / larger);
  }
  return out;
}

}  // namespace couloir
