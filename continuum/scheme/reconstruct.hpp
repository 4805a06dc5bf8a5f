#pragma once
// Piecewise linear reconstruction of h, h + z_b, u, v along one axis (MUSCL).
//
//       lo   q   hi           slope by the limiter from the differences to both neighbours;
//    |  x----x----x  |        (lo + hi) / 2 = q, which the positivity bound of the scheme needs
//
// With friction no slope is drawn in a shock, and the fluxes around it are Rusanov's (hll.hpp): ripples behind a shock never even
// out among frictional material, they push it on. docs/decisions/0005.

#include <vector>

#include "continuum/scheme/axis.hpp"
#include "continuum/scheme/parameters.hpp"

namespace couloir {

// smooth: 0 in the cells in which no slope is drawn, else 1; where nothing asks for that (with_flattening()) it stays as it is.
void find_shocks(const Parameters&, const Block&, const Axis&, const Fields&, Values& smooth);

// All four quantities. On a bed without relief the surface is the depth, and nobody looks at it.
void reconstruct_all(const Parameters&, const Block&, const Axis&, const Fields&, const Scratch&, FaceValues&);

}  // namespace couloir
