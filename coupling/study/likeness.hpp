#pragma once
// What makes two scenes alike for the question which model does for them, in a few plain numbers.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

// Before the first obstacle that the flow meets, of the flow as flow_estimate.hpp expects it; NaN: it has none.
struct Likeness {
  double froude = 0;               // u / sqrt(g cos(zeta) h)
  double depth_over_height = 0;    // of the flow over that of the obstacle
  double depth_over_diameter = 0;  // over the grains'
  double slope = 0;                // [rad]
  std::string obstacle;            // "cuboid across" (the whole width), "cuboid", "tetrahedron", "mesh", "none"
};

Likeness likeness(const Scene&);
// [m] of that flow.
double depth_before(const Scene&);

// sqrt of the sum of: ln^2 of the ratio of each of the first three numbers, (slopes' difference / 10 deg)^2, and 1 for another
// kind of obstacle. 1 is a factor of 2.7 in one number; 0: alike. A number that only one of the two has counts 1.
double distance(const Likeness&, const Likeness&);

// "Froude 3.2, flow 0.3 of the obstacle's height, 5 grains deep, slope 35 deg, obstacle cuboid"
std::string likeness_text(const Likeness&);

nlohmann::ordered_json likeness_json(const Likeness&);
// Throws nlohmann::json::exception where it is none.
Likeness likeness_from(const nlohmann::json&);

}  // namespace couloir
