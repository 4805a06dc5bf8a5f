#pragma once
// One thread's working arrays, as large as the largest block; the same cell index as the block's own arrays.

#include <vector>

namespace couloir {

// Reconstructed values of each cell at its lower and upper face along one axis.
struct FaceValues {
  std::vector<double> h_lo, h_hi;      // depth
  std::vector<double> eta_lo, eta_hi;  // surface h + z_b
  std::vector<double> un_lo, un_hi;    // velocity along the axis
  std::vector<double> ut_lo, ut_hi;    // velocity across it
  void resize(int n) {
    for (auto* a : {&h_lo, &h_hi, &eta_lo, &eta_hi, &un_lo, &un_hi, &ut_lo, &ut_hi}) a->resize(n);
  }
};

// Fluxes through the faces along one axis. Where the bed jumps, the cells on the two sides of a face see different momentum
// fluxes: the bed takes the difference.
struct FaceFluxes {
  std::vector<double> mass;
  std::vector<double> tangent;                     // of the momentum along the face
  std::vector<double> normal;                      // of the momentum across the face, as far as it passes
  std::vector<double> normal_below, normal_above;  // the same as the cell below and the cell above the face see it
  void resize(int n) {
    for (auto* a : {&mass, &tangent, &normal, &normal_below, &normal_above}) a->resize(n);
  }
};

struct Scratch {
  bool still = true;   // some cell is dry or without velocity
  bool locked = true;  // some cell may be locked at rest
  bool jumps = true;   // somewhere the two sides of a face see different fluxes; else normal_below, normal_above are not kept
  std::vector<double> u, v;    // velocity [m/s]
  std::vector<double> eta;     // surface [m]; only on a bed with relief
  std::vector<double> kx, ky;  // earth pressure coefficients; 1 where the closure is hydraulic
  std::vector<double> loose;   // 0 where the cell is locked at rest, else 1
  std::vector<double> smooth;  // 0 in a shock along the present axis, else 1; only with friction or relief
  FaceValues values;
  FaceFluxes x, y;
  std::vector<double> source_x, source_y;    // momentum from the bed within the cell [m2/s2]; only on a bed with relief
  std::vector<double> lost_x, lost_y;        // to friction and cut-off in this stage [m2/s]; only where a control box asks
  std::vector<std::vector<double>> columns;  // sums by column of the block

  void resize(int n) {
    for (auto* a : {&u, &v, &eta, &loose, &smooth, &source_x, &source_y, &lost_x, &lost_y}) a->resize(n);
    for (auto* a : {&kx, &ky}) a->assign(n, 1.0);
    values.resize(n), x.resize(n), y.resize(n);
  }
};

}  // namespace couloir
