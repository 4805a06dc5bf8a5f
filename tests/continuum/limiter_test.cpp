#include "continuum/scheme/limiter.hpp"

#include <gtest/gtest.h>

namespace couloir::test {
namespace {

template <class L>
class LimiterTest : public testing::Test {};
using All = testing::Types<LimiterMinmod, LimiterVanLeer, LimiterMc, LimiterSuperbee>;
TYPED_TEST_SUITE(LimiterTest, All);

TYPED_TEST(LimiterTest, IsExactForALineAndFlatAtExtrema) {
  EXPECT_EQ(TypeParam::slope(0.5, 0.5), 0.5);
  EXPECT_EQ(TypeParam::slope(0.5, -0.1), 0);
  EXPECT_EQ(TypeParam::slope(0.0, 1.0), 0);
  EXPECT_EQ(TypeParam::slope(0.0, 0.0), 0);
}

TYPED_TEST(LimiterTest, IsSymmetricOddAndBounded) {
  for (double a : {0.1, 0.3, 1.0, 7.0}) {
    for (double b : {0.2, 0.3, 5.0}) {
      const double s = TypeParam::slope(a, b);
      EXPECT_EQ(s, TypeParam::slope(b, a));
      EXPECT_EQ(s, -TypeParam::slope(-a, -b));
      EXPECT_GE(s, std::min(a, b) * (1 - 1e-15));
      EXPECT_LE(s, 2 * std::min(a, b) * (1 + 1e-15));
    }
  }
}

TEST(Limiter, ValuesOfEachKind) {
  EXPECT_DOUBLE_EQ(LimiterMinmod::slope(1, 3), 1);
  EXPECT_DOUBLE_EQ(LimiterVanLeer::slope(1, 3), 1.5);
  EXPECT_DOUBLE_EQ(LimiterMc::slope(1, 2), 1.5);
  EXPECT_DOUBLE_EQ(LimiterMc::slope(1, 9), 2);
  EXPECT_DOUBLE_EQ(LimiterSuperbee::slope(1, 3), 2);
}

}  // namespace
}  // namespace couloir::test
