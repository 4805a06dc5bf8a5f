#pragma once
// Continuum -> grains. Behind each segment of a face stands an endless settled block; the segment's raft pulls it forward by its
// own displacement, and grains that pass the insertion plane below the flow's surface enter the driven layer.
//
//      block (tiled)        insertion plane        face
//   ... o o o o o o o o o o |  o o driven o o  | free grains
//                         -layer               0            -> inward
//
// Ledger: the mass the continuum gave is `owed` until grains carry it away. A grain is taken when it lies below the height at
// which the block holds the flow's mass plus what is owed, so `owed` stays within a few grains and does not drift.
// Keeps: mass (to the grain; the rest is owed), velocity of the flow outside. Source: own measurements, docs/coupling.md.

#include <functional>
#include <vector>

#include "coupling/checkpoint/archive.hpp"
#include "coupling/transfer/packing_table.hpp"
#include "coupling/transfer/rim.hpp"

namespace couloir {

class Conveyor {
 public:
  Conveyor(const RimFace&, int face_index, const PackingTable&, double layer);

  // The raft of `segment` moved by `displacement` [m] in the last window (negative: backwards) while the continuum gave
  // `mass` [kg] through the segment's cells, whose depths are depth[k] [m], k over the face's cells. `velocity`
  // [m/s] is the raft's now. `occupied` tells whether a sphere overlaps a driven grain of another segment by more than what
  // is harmless.
  using Occupied = std::function<bool(int segment, const Vec& centre, double radius)>;
  void advance(int segment, double displacement, double mass, const std::vector<double>& depth, double velocity,
               const Occupied& occupied, std::int64_t& next_id, std::vector<NewGrain>& out);

  double owed() const;  // [kg] given by the continuum, not yet grains; all segments
  double owed(int segment) const { return state_[segment].owed; }
  void owe(int segment, double mass) { state_[segment].owed += mass; }
  double position(int segment) const { return state_[segment].position; }  // [m] how far the segment's block has come
  void go_to(int segment, double position);                                // as if it had come so far

  void state(Archive& a) { a(state_); }

 private:
  struct State {          // of one segment
    double position = 0;  // [m] how far the block has come
    double owed = 0;      // [kg]
    long passed = 0;      // grains of the tiled block that have passed the insertion plane
  };
  struct Candidate {
    double x, along, z, r;  // how far the block must come for it, along the face, above the bed
  };
  const RimFace* face_;
  int face_index_;
  const PackingTable* table_;
  double layer_;
  std::vector<std::vector<Candidate>> candidates_;  // by segment, sorted by x
  std::vector<State> state_;
};

}  // namespace couloir
