#include "coupling/loop/clock.hpp"

#include <gtest/gtest.h>

namespace couloir {

TEST(Clock, CountsInIntegersAndEndsWithTheStepThatReachesTheDuration) {
  const double step = 2.34e-5;
  const Clock clock(step, 40, 1.5);
  const auto last = clock.windows();
  EXPECT_GE(clock.time(last), 1.5);
  EXPECT_LT(clock.time(last), 1.5 + step);
  EXPECT_LT(clock.time(last - 1), 1.5);
  EXPECT_EQ(clock.time(1000), step * 40000);
  EXPECT_EQ(clock.steps(1), 40);
  EXPECT_EQ(clock.steps(last), 64103 - 40 * (last - 1)) << "shorter";
  EXPECT_NEAR(clock.length(last), step * double(clock.steps(last)), 1e-12);
}

TEST(Clock, AWindowLongerThanTheRunEndsWithIt) {
  const Clock clock(1e-4, 1000, 0.01);
  EXPECT_EQ(clock.windows(), 1);
  EXPECT_EQ(clock.steps(1), 100);
  EXPECT_DOUBLE_EQ(clock.time(1), 0.01);
}

TEST(Clock, ADurationOfWholeWindowsGetsNoExtraOne) {
  EXPECT_EQ(Clock(1e-3, 1, 1.5).windows(), 1500);
}

TEST(Clock, IntervalsWithoutAnEngineEndAtTheDuration) {
  const Clock clock = Clock::of_intervals(0.4, 1);
  EXPECT_EQ(clock.windows(), 3);
  EXPECT_EQ(clock.time(3), 1);
  EXPECT_DOUBLE_EQ(clock.length(3), 0.2);
}

TEST(Schedule, IsDueOncePerIntervalAndDoesNotDrift) {
  Schedule frames(0.02);
  int count = 0;
  for (int k = 0; k <= 100000; ++k) count += frames.due(k * 1e-5);
  EXPECT_EQ(count, 51);
}

}  // namespace couloir
