#pragma once
// The conserved quantities of one cell, and their exchange through one face.

namespace couloir {

struct FlowState {
  double h = 0, hu = 0, hv = 0;  // [m], [m2/s], [m2/s]
};

// Exchange through one cell face, per unit width, positive in the direction of +x or +y.
struct FaceFlux {
  double mass = 0;              // [m2/s]
  double mom_x = 0, mom_y = 0;  // [m3/s2], pressure included
};

}  // namespace couloir
