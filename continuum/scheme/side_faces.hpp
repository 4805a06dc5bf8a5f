#pragma once
// The faces on the domain's sides. A wall turns the flow back; an outflow side does so with what moves away from it, so that
// nothing enters; through an inflow side comes the depth times velocity that is given, whatever the flow inside does; periodic
// sides take the flux between the cells on both sides.

#include "continuum/boundary/covered_zones.hpp"
#include "continuum/mesh/block.hpp"
#include "continuum/scheme/axis.hpp"
#include "continuum/scheme/parameters.hpp"
#include "continuum/scheme/tally.hpp"

namespace couloir {

// Replaces the fluxes through walls, inflow sides and closed outflow faces.
void side_fluxes(const Parameters&, const Block&, const Axis&, const FaceValues&);

// Books what passes; share: what this stage counts in the step, times dt [s].
void count_sides(const Parameters&, const Block&, const BlockState&, const Axis&, double share, Tally&);

// A face of a covered zone's rim that this block's fluxes meet.
struct RimFace {
  int face;
  bool along_x;  // the axis across the face
  int zone;      // its id
  SideName side;
  int k, part, parts;  // CoveredZone::actual
};

// Replaces the fluxes through the rims by what the zones impose.
void rim_fluxes(const std::vector<RimFace>&, const CoveredZones&, const Axis&);

}  // namespace couloir
