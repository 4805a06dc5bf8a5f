#pragma once
// A settled block read as a table: how much mass lies below a height, and which grains to take for a given flow depth.

#include <vector>

#include "coupling/engine/packing.hpp"

namespace couloir {

class PackingTable {
 public:
  // grain_density [kg/m3]. Throws std::invalid_argument when the block is empty.
  PackingTable(const Packing&, double grain_density);

  const Packing& packing() const { return packing_; }
  double grain_density() const { return grain_density_; }
  double bulk_density() const { return grain_density_ * packing_.solid_fraction; }  // [kg/m3] rho_b
  double grain_mass(double radius) const;                                           // [kg]
  double mean_mass() const { return mean_mass_; }

  // Height below which the centres of grains with `areal_mass` [kg/m2] lie: the inverse of the block's cumulative mass, not of
  // its height, since the lowest layers are looser. -1 where the mass is not positive; above the block where it exceeds it.
  double cut(double areal_mass) const;
  double areal_mass() const { return cumulative_.empty() ? 0 : cumulative_.back(); }  // [kg/m2] of the whole block

 private:
  Packing packing_;
  double grain_density_ = 0, mean_mass_ = 0;
  std::vector<double> height_, cumulative_;  // sorted heights of centres, mass at and below them per area
};

}  // namespace couloir
