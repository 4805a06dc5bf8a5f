#pragma once
// Continuum -> grains. Behind each segment of a face stands an endless settled block; the segment's raft pulls it forward by its
// own displacement, and grains that pass the insertion plane below the flow's surface enter the driven layer. Where the flow
// crosses the face obliquely the blocks slide along it, and grains enter the layer through its upstream end, too.
//
//      block (tiled)        insertion plane        face
//   ... o o o o o o o o o o |  o o driven o o  | free grains       ^ along
//                         -layer               0            -> inward
//
// Ledger: the mass the continuum gave is `owed` until grains carry it away. A grain is taken when it lies below the height at
// which the block holds the flow's mass plus what is owed, so `owed` stays within a few grains and does not drift. What enters
// through an end is not owed: as much leaves through the other end (Zone lends it).
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

  // A segment's last window.
  struct Pull {
    double displacement = 0;  // [m] of its raft along the inward normal
    double mass = 0;          // [kg] that the continuum gave through its cells
    double velocity = 0;      // [m/s] of its raft now, along the inward normal
    double slide = 0;         // [m/s] and along the face
    bool open_end = false;    // no raft stands beyond the end from which it slides
  };
  // Tells whether a sphere overlaps a driven grain of another segment by more than what is harmless.
  using Occupied = std::function<bool(int segment, const Vec& centre, double radius)>;

  void slide(double distance);  // [m] all blocks along the face, in the last window; before its segments advance
  // depth[k] [m] of the flow at the face's cells. Returns the mass [kg] of what entered through the end.
  double advance(int segment, const Pull&, const std::vector<double>& depth, const Occupied&, std::int64_t& next_id,
                 std::vector<NewGrain>& out);

  double owed() const;  // [kg] given by the continuum, not yet grains; all segments
  double owed(int segment) const { return state_[segment].owed; }
  void owe(int segment, double mass) { state_[segment].owed += mass; }
  // As if `segment` of `before` went on as this one's.
  void go_on(int segment, const Conveyor& before, int before_segment);

  void state(Archive& a) { a(state_, slid_, slid_now_); }

 private:
  struct State {          // of one segment
    double position = 0;  // [m] how far the block has come
    double owed = 0;      // [kg]
    long passed = 0;      // grains of the endless block that have passed the insertion plane
  };
  struct Candidate {
    double x, y, z, r;  // [m] how far the block must come for it, across the block, above the bed, radius
  };
  double comes_at(long n) const;  // [m] how far the block must come for its n-th grain, n of any sign
  const Candidate& grain(long n) const;
  double first_place(const Candidate&, double from) const;  // [m] along the face, of its first copy from there on
  bool stands_in_wall(double along, double radius) const;
  NewGrain make(int segment, const Candidate&, double distance, double along, const Pull&) const;
  double take_by_plane(int segment, const Pull&, const std::vector<double>& depth, const Occupied&, std::int64_t& next_id,
                       std::vector<NewGrain>& out);
  double take_by_end(int segment, const Pull&, const std::vector<double>& depth, const Occupied&, std::int64_t& next_id,
                     std::vector<NewGrain>& out) const;

  const RimFace* face_;
  int face_index_;
  const PackingTable* table_;
  double layer_;
  std::vector<Candidate> block_;  // sorted by x
  std::vector<State> state_;
  double slid_ = 0, slid_now_ = 0;  // [m] in all, in the last window
};

}  // namespace couloir
