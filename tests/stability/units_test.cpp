// The same scene in other units: lengths times a factor, times and velocities times its root.

#include "fixture.hpp"

namespace couloir::test {
namespace {

class Units : public Stability {
 protected:
  static Case scene(bool active_passive) {
    Case c = plane(degrees(38), 40, 16, 0.0625, 0.0625);
    c.settings.closure = granular(37, 27);
    if (!active_passive) c.settings.closure.earth_pressure = EarthPressure::hydraulic();
    c.arc = 0.5, c.slope = 1.5, c.runout = 0.5;
    c.bed.obstacles.push_back({"block", 1.25, 1.5, -0.25, 0.125, 0.25});
    c.fill([](double x, double y) { return FlowState{heap(x - 0.5, y, 0.25, 0.375), 0, 0}; });
    return c;
  }
  // Greatest difference of the dimensionless depths and momenta after that many steps.
  double departure(const Case& c, double factor) const {
    const auto first = c.build(GetParam());
    FlowModel& one = *first;
    const Case other_case = scaled(c, factor);
    const auto second = other_case.build(GetParam());
    FlowModel& other = *second;
    for (int k = 0; k < 200; ++k) one.step(one.stable_dt()), other.step(other.stable_dt());
    const Bits a = bits_of(one), b = bits_of(other);
    const double momentum = factor * std::sqrt(factor);
    double most = std::abs(other.time() / std::sqrt(factor) - one.time());
    for (std::size_t k = 0; k < a.h.size(); ++k) {
      most = std::max({most, std::abs(b.h[k] / factor - a.h[k]), std::abs(b.hu[k] / momentum - a.hu[k]),
                       std::abs(b.hv[k] / momentum - a.hv[k])});
    }
    EXPECT_EQ(one.steps(), other.steps());
    return most;
  }
};

// Powers of four only shift exponents, so that every bit must agree.
TEST_P(Units, PowersOfFourKeepEveryBit) {
  for (double factor : {0x1p-40, 0x1p-20, 0x1p20, 0x1p40}) {
    EXPECT_EQ(departure(scene(true), factor), 0) << factor;
    EXPECT_EQ(departure(scene(false), factor), 0) << factor;
  }
}

TEST_P(Units, AMillionthAndAMillionGiveTheSameNumbers) {
  for (double factor : {1e-6, 1e6}) {
    const double most = std::max(departure(scene(true), factor), departure(scene(false), factor));
    std::printf("factor %g: greatest departure %.1e\n", factor, most);
    EXPECT_LT(most, 1e-10) << factor;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Units, testing::ValuesIn(subjects()), subject_name);

}  // namespace
}  // namespace couloir::test
