#include "coupling/transfer/packing_table.hpp"

#include <gtest/gtest.h>

#include "stock.hpp"

namespace couloir {

TEST(PackingTable, CutInvertsTheCumulativeMass) {
  const Packing p = lattice_packing();
  const PackingTable table(p, 2500);
  for (double share : {0.1, 0.35, 0.5, 0.9}) {
    const double asked = share * table.areal_mass(), z = table.cut(asked);
    double below = 0;
    for (const auto& g : p.grains)
      if (g.z <= z) below += table.grain_mass(g.r);
    below /= p.length * p.width;
    EXPECT_GE(below, asked * (1 - 1e-12));
    EXPECT_LE(below - asked, 1.01 * table.grain_mass(0.0024) / (p.length * p.width)) << "to one grain";
  }
}

TEST(PackingTable, NothingForNoMassAndAllForTooMuch) {
  const PackingTable table(lattice_packing(), 2500);
  EXPECT_LT(table.cut(0), 0);
  EXPECT_LT(table.cut(-1), 0);
  EXPECT_GT(table.cut(2 * table.areal_mass()), table.packing().depth);
}

TEST(PackingTable, RefusesAnEmptyBlock) {
  EXPECT_THROW(PackingTable(Packing{}, 2500), std::invalid_argument);
}

}  // namespace couloir
