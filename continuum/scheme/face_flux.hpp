#pragma once
// Fluxes through the faces along one axis by hydrostatic reconstruction (Audusse et al. 2004) and HLL, and the bed's push within
// the cells. Exact for a lake at rest (K = 1).
//
//   z* = max(zl, zr),  h* = max(0, h - (z* - z) / K) on each side
//   normal flux seen from one side = HLL(h*l, h*r) + p(h) - p(h*),   p(h) = K g cos(zeta) h^2 / 2
//
// plus, on a side where the bed rises steeply above all that the head reaches, what a wall turns back beyond p(h) (wall_flux()).
//
// What balances is K h + z_b, since the bed's push in (2.91), (2.92) carries no K: for a small rise p(h) - p(h*) is
// g cos(zeta) h (z* - z), and against a wall that nothing passes it is all of the pressure p(h), never more.
//
// A film whose way down the slope is blocked by the bed meets a wall there: else the slope's drive, which no pressure of a film
// balances, would give it speed without end.

#include <vector>

#include "continuum/scheme/axis.hpp"
#include "continuum/scheme/parameters.hpp"

namespace couloir {

// No slopes in a cell at the foot of a wall, where the bed rises steeply above the head on one side and does not fall half as
// steeply on the other: what lies behind such a rise says nothing of the surface before it.
void flatten_at_feet(const Block&, const Axis&, const Fields&, Values& smooth);

// Between two locked cells the mass flux is exactly zero, between two films all of it: what lies beside may not be looked at.
void face_fluxes(const Parameters&, const Block&, const Axis&, const Scratch&, const FaceValues&);

// axis.source: the bed's push within the cell, -g cos(zeta) h dz_b/dx.
void bed_source(const Block&, const Axis&, const FaceValues&);

}  // namespace couloir
