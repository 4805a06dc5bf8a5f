#pragma once
// Grains -> continuum. A grain whose centre leaves the zone through a face gives its mass and momentum to the cell outside, once,
// when it crosses. It then lives on as a `shadow`: still there for the grains inside to lean on (an open exit would make a
// rarefaction that reaches 10 to 15 d upstream), but no longer counted. Shadows end at the buffer's far side; one that comes back
// takes its mass back from the continuum. Out of a fast flow (normal Froude number above 2) nothing travels back in, and a short
// buffer will do. Where the flow outside comes in, a grain that is a diameter out is handed back and
// removed: the driven layer stands there. A grain in the air is neither handed back nor a shadow: it flies on (airborne.hpp).
//
// Keeps: mass (exactly), momentum along the surface (exactly; the part along the normal is lost to the bed).

#include <cstdint>
#include <functional>
#include <vector>

#include "coupling/checkpoint/archive.hpp"
#include "coupling/transfer/rim.hpp"

namespace couloir {

struct Parcel {                 // on its way into the cell outside of face cell k
  double mass = 0;              // [kg] negative: to be taken
  double mom_x = 0, mom_y = 0;  // [N s] reference coordinates
};

class Handback {
 public:
  Handback(const Rim&, const ReferenceSurface&, double grain_density);

  struct Outside {        // of a segment
    bool inflow = false;  // the flow comes in there
    double buffer = 0;    // [m] how far out shadows live
  };
  // Sorts out all free grains after a window. `outside[face][segment]`.
  // Appends to `remove` the ids that must go. `flies`: takes over a grain that is in the air; it is no shadow then.
  using Flies = std::function<bool(std::size_t grain)>;
  void sort(const Grains&, const std::vector<std::vector<Outside>>& outside, std::vector<std::int64_t>& remove,
            const Flies& flies = {});

  std::vector<std::vector<Parcel>>& pending() { return pending_; }  // [face][cell]
  const std::vector<std::vector<Parcel>>& pending() const { return pending_; }
  double pending_mass() const;      // [kg]
  double pending_momentum() const;  // [N s] along x
  bool is_shadow(std::int64_t id) const { return id < std::int64_t(shadow_.size()) && shadow_[id]; }
  void mark_shadow(std::int64_t id);
  long returned() const { return returned_; }  // grains handed back since the start
  void unmark_shadow(std::int64_t id) { shadow_[id] = 0; }
  void inherit(const Handback& before) { shadow_ = before.shadow_, returned_ = before.returned_; }  // all but what is pending
  void state(Archive& a) { a(pending_, shadow_, returned_); }

 private:
  const Rim* rim_;
  const ReferenceSurface* surface_;
  double density_;
  std::vector<std::vector<Parcel>> pending_;
  std::vector<char> shadow_;  // by id
  long returned_ = 0;
};

}  // namespace couloir
