#include "continuum/mesh/forest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

namespace couloir::test {
namespace {

double area(const Forest& f) {
  double sum = 0;
  for (const Leaf& l : f.leaves()) sum += std::ldexp(1.0, -2 * l.level);
  return sum;
}

// The greatest difference of level between two leaves that touch, over a corner too.
int jump(const Forest& f, int nx, int ny, int levels) {
  std::set<std::tuple<int, int, int>> all;
  for (const Leaf& l : f.leaves()) all.insert({l.level, l.bi, l.bj});
  const auto level_at = [&](int i, int j) {  // of a place counted in the finest blocks
    for (int level = 0; level <= levels; ++level) {
      if (all.count({level, i >> (levels - level), j >> (levels - level)})) return level;
    }
    return -1;
  };
  int most = 0;
  const int n = nx << levels, m = ny << levels;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      for (int dj : {-1, 0, 1}) {
        for (int di : {-1, 0, 1}) {
          if (i + di < 0 || j + dj < 0 || i + di >= n || j + dj >= m) continue;
          most = std::max(most, std::abs(level_at(i, j) - level_at(i + di, j + dj)));
        }
      }
    }
  }
  return most;
}

TEST(Forest, GrowsAboutAPlaceAndStaysBalanced) {
  Forest f(5, 3, false, false, 3);
  EXPECT_EQ(f.leaves().size(), 15u);
  const auto about = [](const Leaf& l) {
    const double size = std::ldexp(1.0, -l.level), x = l.bi * size, y = l.bj * size;
    return x <= 2.1 && x + size > 2.1 && y <= 1.4 && y + size > 1.4 ? 3 : 0;
  };
  int rounds = 0;
  while (f.adapt(about)) ++rounds;
  EXPECT_GE(rounds, 3);
  EXPECT_DOUBLE_EQ(area(f), 15);
  EXPECT_EQ(jump(f, 5, 3, 3), 1);
  EXPECT_EQ(std::count_if(f.leaves().begin(), f.leaves().end(), [](const Leaf& l) { return l.level == 3; }), 4);
  while (f.adapt([](const Leaf&) { return 0; })) {
  }
  EXPECT_EQ(f.leaves().size(), 15u);
}

TEST(Forest, BecomesWhatItWas) {
  Forest f(4, 4, true, false, 2), g(4, 4, true, false, 2);
  while (f.adapt([](const Leaf& l) { return l.bi == 0 ? 2 : 0; })) {
  }
  g.become(f.leaves());
  EXPECT_EQ(f.leaves(), g.leaves());
}

}  // namespace
}  // namespace couloir::test
