#include "coupling/calibration/bracket.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace couloir;

namespace {

const Bracket usual{0, 1, 0.3, 0.6, 1e-4, 1e-6, 30};

}  // namespace

TEST(Bracket, FindsWhereAClosedFunctionReachesItsTarget) {
  const auto saturating = [](double x) { return 1 - std::exp(-3 * x); };
  for (const double target : {0.05, 0.4, 0.6, 0.8, 0.94}) {
    const BracketResult r = search_bracket(usual, target, saturating);
    EXPECT_TRUE(r.bracketed) << target;
    EXPECT_NEAR(r.best.quantity, target, 1e-4) << target;
    EXPECT_NEAR(r.best.parameter, -std::log(1 - target) / 3, 1e-3) << target;
    EXPECT_LE(r.tries.size(), 12u) << target;
  }
}

TEST(Bracket, StopsAtTheFirstTryThatIsNearEnough) {
  const BracketResult r = search_bracket({0, 1, 0.5, 0.6, 0.01, 0.001, 8}, 0.505, [](double x) { return x; });
  EXPECT_EQ(r.tries.size(), 1u);
  EXPECT_EQ(r.best.parameter, 0.5);
}

TEST(Bracket, EndsWhereTheBracketIsNarrowThoughTheQuantityJumps) {
  const BracketResult r = search_bracket({0, 1, 0, 1, 1e-6, 0.01, 100}, 0.5, [](double x) { return x < 0.37 ? 0.0 : 1.0; });
  EXPECT_TRUE(r.bracketed);
  EXPECT_LE(r.high - r.low, 0.01);
  EXPECT_LE(r.low, 0.37);
  EXPECT_GE(r.high, 0.37);
}

TEST(Bracket, SaysWhatIsOutOfReachAndGivesTheNearest) {
  const BracketResult above = search_bracket(usual, 2, [](double x) { return x; });
  EXPECT_FALSE(above.bracketed);
  EXPECT_EQ(above.best.parameter, 1);
  const BracketResult below = search_bracket(usual, -1, [](double x) { return x; });
  EXPECT_FALSE(below.bracketed);
  EXPECT_EQ(below.best.parameter, 0);
  // it falls again before it is there, as delta does where grains roll
  const BracketResult hump = search_bracket(usual, 0.5, [](double x) { return x < 0.5 ? x : 0.9 - x; });
  EXPECT_FALSE(hump.bracketed);
  EXPECT_LT(hump.best.quantity, 0.5);
}
