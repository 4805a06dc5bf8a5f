#include "coupling/loop/costs.hpp"

namespace couloir {

const char* effect_of(StepPart part) {
  switch (part) {
    case StepPart::mesh:
    case StepPart::levels:
      return "refinement";
    case StepPart::earth_pressure:
      return "earth_pressure";
    case StepPart::rest:
    case StepPart::shocks:
      return "basal_friction";
    case StepPart::bed:
      return "elevation";
    case StepPart::bed_steps:
      return "steps_of_the_bed";
    case StepPart::zone_rims:
      return "coupling";
    case StepPart::planes:
      return "planes";
    default:
      return "depth_averaged_flow";
  }
}

std::vector<PartCost> costs_of(const PartTimes& times) {
  std::vector<PartCost> costs;
  for (int p = 0; p < part_count; ++p) {
    const StepPart part = static_cast<StepPart>(p);
    if (times[p] > 0) costs.push_back({to_string(part), effect_of(part), times[p]});
  }
  return costs;
}

double sum(const std::vector<PartCost>& costs) {
  double all = 0;
  for (const PartCost& c : costs) all += c.seconds;
  return all;
}

void scale_to(std::vector<PartCost>& costs, double seconds) {
  const double all = sum(costs);
  for (PartCost& c : costs) c.seconds *= all > 0 ? seconds / all : 0;
}

}  // namespace couloir
