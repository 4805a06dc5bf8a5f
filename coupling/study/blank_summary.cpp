#include "coupling/study/blank_summary.hpp"

#include "coupling/loop/flow_models.hpp"
#include "coupling/loop/force_measures.hpp"
#include "coupling/loop/stress_gauges.hpp"
#include "coupling/plan/zone.hpp"
#include "coupling/records/summary.hpp"

namespace couloir {

nlohmann::json blank_summary(const Scene& scene) {
  RunStart start;
  start.scene = &scene;
  start.grid.nx = scene.mode == Mode::grains ? 0 : 1;  // there is a continuum
  start.planes_obstacle = planes_obstacle(scene);
  start.measures = wall_measures(scene);
  std::vector<PlannedZone> zones;
  if (scene.mode == Mode::coupled) zones = planned_zones(scene);
  start.stress_gauges = stress_gauges(scene, zones);
  for (const ObstacleSpec& o : scene.obstacles) {
    start.obstacles.push_back(o.name);
    if (scene.mode == Mode::grains || !all_apart(zones, o)) continue;
    start.measures.push_back({o.name, "control_volume"});
    if (o.method != ObstacleSpec::Method::elevation) continue;
    for (const char* kind : {"elevation", "elevation_upstream"}) start.measures.push_back({o.name, kind});
  }
  if (scene.mode != Mode::continuum) start.window = start.sample_interval = 1;  // there are samples
  Summary summary("");
  summary.on_start(start);
  return nlohmann::json::parse(summary.made({}));
}

}  // namespace couloir
