#include "coupling/study/mass_point_run.hpp"

#include <chrono>
#include <ctime>

#include "coupling/plan/impact.hpp"
#include "coupling/plan/release.hpp"
#include "coupling/study/blank_summary.hpp"

namespace couloir {
namespace {

void forget(nlohmann::json& node) {
  if (node.is_number()) {
    node = nullptr;
  } else if (node.is_structured()) {
    for (nlohmann::json& below : node) forget(below);
  }
}

// [s] of this process.
double cpu_clock() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

nlohmann::json mass_point_summary(const Scene& scene) {
  nlohmann::json out = blank_summary(scene);
  forget(out);
  const auto start = std::chrono::steady_clock::now();
  const double cpu = cpu_clock();
  const std::vector<FlowEstimate> line = flow_estimate(scene);
  for (const ImpactEstimate& i : impact_estimates(scene)) {
    nlohmann::json& o = out["obstacles"][i.obstacle];
    o["force_peak"] = i.force();
    o["first_contact"] = i.arrival;
  }
  for (const GaugeSpec& gauge : scene.record.gauges) {
    const std::optional<double> arrival = front_arrival(scene, line, gauge.x);
    if (!out["gauges"].contains(gauge.name) || !arrival) continue;
    const FlowEstimate flow = flow_estimate_at(scene, gauge.x);
    nlohmann::json& g = out["gauges"][gauge.name];
    g["arrival"] = *arrival;
    g["max_depth"] = flow.depth;
    g["max_speed"] = flow.velocity;
  }
  out["mass"]["initial"] = release_volume(scene) * scene.material.density;
  double fastest = 0;
  for (const FlowEstimate& f : line)
    if (f.time <= scene.duration) fastest = std::max(fastest, f.velocity);
  out["flow"]["max_speed"] = fastest;
  out["time"]["cpu"] = cpu_clock() - cpu;
  out["time"]["wall"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out["continuum"]["cell_updates"] = out["grains"]["particle_steps"] = 0;
  return out;
}

}  // namespace couloir
