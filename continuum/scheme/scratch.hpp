#pragma once
// One thread's working arrays, as large as the largest block; the same cell index as the block's own arrays.

#include <vector>

#include "continuum/scheme/laps.hpp"
#include "continuum/scheme/values.hpp"

namespace couloir {

// Reconstructed values of each cell at its lower and upper face along one axis.
struct FaceValues {
  Values h_lo, h_hi;      // depth
  Values eta_lo, eta_hi;  // surface h + z_b
  Values un_lo, un_hi;    // velocity along the axis
  Values ut_lo, ut_hi;    // velocity across it
  void resize(int n) {
    for (auto* a : {&h_lo, &h_hi, &eta_lo, &eta_hi, &un_lo, &un_hi, &ut_lo, &ut_hi}) a->resize(n);
  }
};

// Fluxes through the faces along one axis. Where the bed jumps, the cells on the two sides of a face see different momentum
// fluxes: the bed takes the difference.
struct FaceFluxes {
  Values mass;
  Values tangent;                     // of the momentum along the face
  Values normal;                      // of the momentum across the face, as far as it passes
  Values normal_below, normal_above;  // the same as the cell below and the cell above the face see it
  void resize(int n) {
    for (auto* a : {&mass, &tangent, &normal, &normal_below, &normal_above}) a->resize(n);
  }
};

struct Scratch {
  bool still = true;   // some cell is dry or without velocity
  bool locked = true;  // some cell may be locked at rest
  // Both cells at a face see the same flux: normal_below and normal_above are not kept. Only where nothing is locked or covered,
  // too, as update() knows no other case.
  bool one_flux = false;
  Values u, v;    // velocity [m/s]
  Values eta;     // surface [m]; only on a bed with relief
  Values kx, ky;  // earth pressure coefficients; 1 where the closure is hydraulic
  Values loose;   // 0 where the cell is locked at rest, else 1
  Values smooth;  // 0 in a shock along the present axis, else 1; only with friction or relief
  FaceValues values;
  FaceFluxes x, y;
  Values source_x, source_y;    // momentum from the bed within the cell [m2/s2]; only on a bed with relief
  Values lost_x, lost_y;        // to friction and cut-off in this stage [m2/s]; only where a control box asks
  std::vector<Values> columns;  // sums by column of the block
  Laps laps;                    // of the kernels on this thread

  void resize(int n) {
    for (auto* a : {&u, &v, &eta, &loose, &smooth, &source_x, &source_y, &lost_x, &lost_y}) a->resize(n);
    for (auto* a : {&kx, &ky}) a->assign(n, 1.0);
    values.resize(n), x.resize(n), y.resize(n);
  }
};

}  // namespace couloir
