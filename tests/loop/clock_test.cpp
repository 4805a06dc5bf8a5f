#include "coupling/loop/clock.hpp"

#include <gtest/gtest.h>

namespace couloir {

TEST(Clock, CountsWindowsInIntegersAndReachesTheDuration) {
  const Clock clock(2.34e-5, 40, 1.5);
  EXPECT_GE(clock.time(clock.windows()), 1.5);
  EXPECT_LT(clock.time(clock.windows() - 1), 1.5);
  EXPECT_EQ(clock.time(1000), 2.34e-5 * 40000);
}

TEST(Clock, ADurationOfWholeWindowsGetsNoExtraOne) {
  EXPECT_EQ(Clock(1e-3, 1, 1.5).windows(), 1500);
}

TEST(Schedule, IsDueOncePerIntervalAndDoesNotDrift) {
  Schedule frames(0.02);
  int count = 0;
  for (int k = 0; k <= 100000; ++k) count += frames.due(k * 1e-5);
  EXPECT_EQ(count, 51);
}

}  // namespace couloir
