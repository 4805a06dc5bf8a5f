#include "coupling/scene/names.hpp"

#include <gtest/gtest.h>

namespace couloir {
namespace {

TEST(Names, CountsSlips) {
  EXPECT_EQ(edit_distance("friction", "friction"), 0);
  EXPECT_EQ(edit_distance("frction", "friction"), 1);
  EXPECT_EQ(edit_distance("firction", "friction"), 1);  // a swap
  EXPECT_EQ(edit_distance("", "cell"), 4);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(Names, SuggestsOnlyWhatIsNear) {
  EXPECT_EQ(nearest_name("sed", {"seed", "spread"}), "seed");
  EXPECT_EQ(nearest_name("colour", {"cell", "cfl", "closure"}), "");
  EXPECT_EQ(suggestion("sed", {"seed"}, "takes"), "; did you mean 'seed'?");
  EXPECT_EQ(suggestion("xyz", {"a", "b"}, "grains takes"), "; grains takes a, b");
}

}  // namespace
}  // namespace couloir
