#include "coupling/calibration/record.hpp"

#include <gtest/gtest.h>

#include "coupling/scene/scene_error.hpp"

using namespace couloir;

namespace {

CalibrationRecord some_record() {
  CalibrationRecord r;
  r.material = "gravel's";
  r.source = "Table 4.1 (Chiou 2006): quartz: 'dry'";
  r.engine = "LIGGGHTS 3.8.0";
  r.contact = "hertz";
  r.rotation = "free";
  r.diameter = 0.005;
  r.seeds = {20011, 30018};
  r.grains = {1, 0.4, 0.5317, 0.15};
  r.delta = {28, 27.96, 0.12, true};
  r.phi = {40, 32.5, 0.3, false};
  r.delta_speed_change = -0.25;
  r.notes = {"phi is out of reach: see below", "second"};
  r.phi_search = {{1, 0.15, 0.53}, {1, 1, 0.61}};
  r.phi_slabs = {{10, 0, 0.06, 0.61}, {10, 1, 0.2, 0.66}};
  return r;
}

std::string error_of(const std::string& text) {
  try {
    read_calibration(text, "gravel.yaml");
  } catch (const SceneError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST(CalibrationRecord, ReadsBack) {
  const CalibrationRecord r = some_record();
  const std::string text = write_calibration(r);
  const CalibrationRecord back = read_calibration(text, "gravel.yaml");
  EXPECT_EQ(write_calibration(back), text);
  EXPECT_EQ(back.source, r.source);
  EXPECT_EQ(back.grains, r.grains);
  EXPECT_EQ(back.delta.reached, r.delta.reached);
  EXPECT_TRUE(back.delta.met);
  EXPECT_FALSE(back.phi.met);
  EXPECT_EQ(back.notes, r.notes);
  EXPECT_EQ(back.phi_slabs, r.phi_slabs);
  EXPECT_TRUE(back.delta_slabs.empty());
}

TEST(CalibrationRecord, SaysWhatIsWrong) {
  const std::string text = write_calibration(some_record());
  const auto without = [&](const std::string& old, const std::string& now) {
    std::string t = text;
    t.replace(t.find(old), old.size(), now);
    return error_of(t);
  };
  EXPECT_NE(error_of("name: quartz\n").find("gravel.yaml: this is no calibration record"), std::string::npos);
  EXPECT_NE(without("base_friction:", "bas_friction:").find("lacks 'base_friction'"), std::string::npos);
  EXPECT_EQ(without("diameter: 0.005", "diameter: fine"), "gravel.yaml:8: 'fine' is no number; calibrate again");
  EXPECT_NE(without("[1, 0.15, 0.53]", "[1, 0.15]").find("a row of phi_search has 3 numbers"), std::string::npos);
}
