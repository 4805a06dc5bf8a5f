// The materials in dem_inputs have the values of the records that they name.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "coupling/calibration/record.hpp"
#include "coupling/scene/reader.hpp"

using namespace couloir;

namespace {

const std::string inputs = COULOIR_SOURCE_DIR "/dem_inputs";

CalibrationRecord record_of(const Material& m) {
  const std::string path = inputs + "/calibrations/" + m.calibration + ".yaml";
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  const CalibrationRecord r = read_calibration(text.str(), path);
  EXPECT_EQ(write_calibration(r), text.str()) << path << " has been changed by hand";
  return r;
}

}  // namespace

TEST(CalibratedMaterials, HaveTheValuesOfTheirRecords) {
  for (const char* name : {"quartz", "toyoura", "vestolen", "yellow_sand"}) {
    const Material m = read_material(name, inputs + "/materials");
    const CalibrationRecord r = record_of(m);
    EXPECT_EQ(r.material, name);
    const double deg = 180 / std::numbers::pi;
    EXPECT_NEAR(r.delta.asked, m.delta * deg, 1e-3) << name;
    EXPECT_NEAR(r.phi.asked, m.phi * deg, 1e-3) << name;
    EXPECT_NEAR(m.grain.friction, r.grains.friction, 1e-3) << name;
    EXPECT_NEAR(m.grain.rolling_friction, r.grains.rolling_friction, 1e-3) << name;
    EXPECT_NEAR(m.grain.base_friction, r.grains.base_friction, 1e-3) << name;
    EXPECT_NEAR(m.grain.base_rolling_friction, r.grains.base_rolling_friction, 1e-3) << name;
    EXPECT_EQ(r.restitution, m.grain.restitution) << name;
    // Toyoura sand's delta is its phi: slabs shear within about where they slide, and miss it by little.
    EXPECT_EQ(r.delta.met, std::string(name) != "toyoura") << name;
    EXPECT_NEAR(r.delta.reached, r.delta.asked, 0.15) << name;
    // of the replicates and slabs that the record lists
    double mu = 0;
    for (const auto& slab : r.delta_slabs) mu += slab[3] / static_cast<double>(r.delta_slabs.size());
    EXPECT_NEAR(std::atan(mu) * deg, r.delta.reached, 0.01) << name;
  }
}
