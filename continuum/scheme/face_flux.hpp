#pragma once
// Fluxes through the faces along one axis by hydrostatic reconstruction (Audusse et al. 2004) and HLL, and the bed's push within
// the cells. Exact for a lake at rest.
//
//   z* = max(zl, zr),  h* = max(0, h + z - z*) on each side
//   normal flux seen from one side = HLL(h*l, h*r) + p(h) - p(h*),   p(h) = K g cos(zeta) h^2 / 2

#include "continuum/scheme/axis.hpp"

namespace couloir {

// Between two locked cells the mass flux is exactly zero.
void face_fluxes(const Block&, const Axis&, const Scratch&, const FaceValues&);

// axis.source: -K g cos(zeta) h dz_b/dx, which balances the pressure, and -(1 - K) g cos(zeta) h dz_b/dx, the rest of the bed's
// push, which in (2.91), (2.92) carries no K.
void bed_source(const Block&, const Axis&, const Fields&, const FaceValues&);

}  // namespace couloir
