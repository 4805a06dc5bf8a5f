#pragma once
// Fluxes through the faces along one axis by hydrostatic reconstruction (Audusse et al. 2004) and HLL, and the bed's push within
// the cells. Exact for a lake at rest.
//
//   z* = max(zl, zr),  h* = max(0, h + z - z*) on each side
//   normal flux seen from one side = HLL(h*l, h*r) + b(h) - b(h*),   b(h) = g cos(zeta) h^2 / 2
//
// The pressure in the HLL flux carries K, the bed's push b, as in (2.91) and (2.92), does not: it is the same limited push in the
// cell and at its faces, so that a film on a steep bed is not pushed uphill. A film whose way down the slope is blocked by the
// bed meets a wall there: else the slope's drive, which no pressure of a film balances, would give it speed without end.

#include "continuum/scheme/axis.hpp"

namespace couloir {

// Between two locked cells the mass flux is exactly zero.
void face_fluxes(const Block&, const Axis&, const Scratch&, const FaceValues&);

// axis.source: the bed's push within the cell, -g cos(zeta) h dz_b/dx.
void bed_source(const Block&, const Axis&, const FaceValues&);

}  // namespace couloir
