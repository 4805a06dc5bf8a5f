#pragma once
// One of the two directions of a block, so that x and y share their code.

#include "continuum/flow/earth_pressure.hpp"
#include "continuum/mesh/block.hpp"
#include "continuum/scheme/scratch.hpp"

namespace couloir {

struct Axis {
  bool along_x;
  int step;              // from a cell to its upper neighbour
  int faces_i, faces_j;  // faces of the block: 0 <= i < faces_i, 0 <= j < faces_j
  double spacing;        // [m] of the cells along the axis
  double face_length;    // [m]
  const double* h;       // depth
  const double* un;      // velocity along and across
  const double* ut;
  const double* k;           // earth pressure coefficient
  const double* passive;     // share of the passive state; null where K does not depend on it
  double stiffness;          // of K to strain (mobilisation.hpp)
  const double* weight;      // g cos(zeta) at the faces, by column: index i + ghosts
  const double* foot_depth;  // [m] 2 dx tan(zeta) of the cell below the face; 0 across the slope; like weight
  FaceFluxes* fluxes;
  double* source;

  static Axis x(const Block& b, const BlockState& s, Scratch& w, const EarthPressure& closure) {
    return {true,
            1,
            b.nx + 1,
            b.ny,
            b.grid.dx,
            b.grid.dy,
            s.now.h.data(),
            w.u.data(),
            w.v.data(),
            w.kx.data(),
            s.passive_x.data(),
            closure.stiffness_x(),
            b.weight_face.data(),
            b.foot_depth.data(),
            &w.x,
            w.source_x.data()};
  }
  static Axis y(const Block& b, const BlockState& s, Scratch& w, const EarthPressure& closure) {
    return {false,           b.row(),           b.nx,       b.ny + 1,         b.grid.dy,          b.grid.dx,
            s.now.h.data(),  w.v.data(),        w.u.data(), w.ky.data(),      s.passive_y.data(), closure.stiffness_y(),
            b.weight.data(), b.no_depth.data(), &w.y,       w.source_y.data()};
  }
  // Cells whose face values the block's fluxes need: the interior and one ghost at either end of the axis.
  int first_i() const { return along_x ? -1 : 0; }
  int first_j() const { return along_x ? 0 : -1; }
};

}  // namespace couloir
