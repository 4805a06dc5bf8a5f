#pragma once
// Fluxes through the faces along one axis by hydrostatic reconstruction (Audusse et al. 2004) and HLL, and the bed's push within
// the cells. Exact for a lake at rest.
//
//   z* = max(zl, zr),  h* = max(0, h + z - z*) on each side
//   normal flux seen from one side = HLL(h*l, h*r) + b(h) - b(h*) + (1 - h*/h)^2 (wall_flux(h, u) - b(h))
//   b(h) = g cos(zeta) h^2 / 2
//
// The pressure in the HLL flux carries K, the bed's push b, as in (2.91) and (2.92), does not: it is the same limited push in the
// cell and at its faces, so that a film on a steep bed is not pushed uphill. The last term
// stops what runs into a bed that rises above its surface: without it the slope's drive would pile up momentum there for ever.

#include "continuum/scheme/axis.hpp"

namespace couloir {

// Between two locked cells the mass flux is exactly zero.
void face_fluxes(const Block&, const Axis&, const Scratch&, const FaceValues&);

// axis.source: the bed's push within the cell, -g cos(zeta) h dz_b/dx.
void bed_source(const Block&, const Axis&, const FaceValues&);

}  // namespace couloir
