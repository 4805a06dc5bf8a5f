#include "coupling/loop/flow_models.hpp"

#include "continuum/noc/nested_noc.hpp"
#include "continuum/noc/noc_solver.hpp"
#include "continuum/planes/planes_model.hpp"
#include "continuum/solver.hpp"
#include "coupling/plan/build.hpp"

namespace couloir {

int planes_obstacle(const Scene& scene) {
  if (scene.mode != Mode::continuum) return -1;
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    if (scene.obstacles[k].method == ObstacleSpec::Method::planes) return static_cast<int>(k);
  }
  return -1;
}

std::unique_ptr<FlowModel> flow_model(const Scene& scene, const ReferenceSurface& surface, const StepBed& bed, int threads) {
  SolverSettings settings = solver_settings(scene);
  settings.threads = threads;
  const int planes = planes_obstacle(scene);
  if (planes >= 0) return std::make_unique<PlanesModel>(settings, surface, bed, planes, scene.obstacles[planes].eta);
  if (scene.continuum.scheme == "noc") {
    if (settings.refinement.empty()) return std::make_unique<NocSolver>(settings, surface, noc_bed(scene));
    return std::make_unique<NestedNoc>(settings, surface, noc_bed(scene));
  }
  return std::make_unique<Solver>(settings, surface, bed);
}

}  // namespace couloir
