#pragma once
// Continuum -> grains. Behind each segment of a face stands an endless settled block; the segment's raft pulls it forward by its
// own displacement, and grains that pass the insertion plane below the flow's surface enter the driven layer. Where the flow
// crosses the face obliquely the blocks slide along it, and grains enter the layer through its upstream end, too.
//
//      block (tiled)        insertion plane        face
//   ... o o o o o o o o o o |  o o driven o o  | free grains       ^ along
//                         -layer               0            -> inward
//
// A driven layer is a copy of the flow that stands there in the continuum: its grains count for nothing. What counts is what
// passes the face, and it passes there in both models at once: a front that comes finds its block at the face, and the plane
// moves back to its place while the block comes in.
//
// Ledger: `owed` is what the continuum gave through a segment less what its raft has let go of into the zone. The blocks are cut
// so that the layer holds its copy and what is owed, which so stays within a few grains and does not drift. Keeps: mass (to the
// grain; the rest is owed), velocity of the flow outside. Source: own measurements, docs/coupling.md.

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
    double due = 0;           // [kg] by which the layer should be heavier for its copy and what is owed
    double velocity = 0;      // [m/s] of its raft now, along the inward normal
    double slide = 0;         // [m/s] and along the face
    bool open_end = false;    // no raft stands beyond the end from which it slides
  };
  // Tells whether a sphere overlaps one that stands there by more than what is harmless: a driven one of another raft, where the
  // face slides of its own, too, or a free one.
  using Occupied = std::function<bool(int segment, const Vec& centre, double radius)>;

  void slide(double distance);  // [m] all blocks along the face, in the last window; before its segments advance
  // depth[k] [m] of the flow at the plane before the face's cells.
  void advance(int segment, const Pull&, const std::vector<double>& depth, const Occupied&, std::int64_t& next_id,
               std::vector<NewGrain>& out);
  void empty(int segment) { state_[segment].filled = 0; }              // its next block comes to the face first
  void fill_up(int segment) { state_[segment].filled = layer_; }       // its layer has been filled by others
  bool filling() const;                                                // some layer is not deep yet
  double filled(int segment) const { return state_[segment].filled; }  // [m] how deep the layer is

  double owed() const;  // [kg] given by the continuum, not yet let go of; all segments
  double owed(int segment) const { return state_[segment].owed; }
  void owe(int segment, double mass) { state_[segment].owed += mass; }
  // As if `segment` of `before` went on as this one's.
  void go_on(int segment, const Conveyor& before, int before_segment);

  void state(Archive& a) { a(state_, slid_, slid_now_); }

 private:
  struct State {          // of one segment
    double position = 0;  // [m] how far the block has come
    double filled = 0;    // [m] how far the plane stands before the face: less than the layer while a first block comes in
    double owed = 0;      // [kg]
    long passed = 0;      // grains of the endless block that have passed the insertion plane
  };
  struct Candidate {
    double x, y, z, r;  // [m] how far the block must come for it, across the block, above the bed, radius
  };
  double comes_at(long n) const;  // [m] how far the block must come for its n-th grain, n of any sign
  const Candidate& grain(long n) const;
  long first_after(double come) const;                      // the block's first grain for which it must come farther
  double first_place(const Candidate&, double from) const;  // [m] along the face, of its first copy from there on
  bool stands_in_wall(double along, double radius) const;
  NewGrain make(int segment, const Candidate&, double distance, double along, const Pull&) const;
  double reach(const State& s) const { return s.position - layer_ + s.filled; }  // [m] how far has come what passed the plane
  void take_by_plane(int segment, double before, const Pull&, const std::vector<double>& depth, const Occupied&,
                     std::int64_t& next_id, std::vector<NewGrain>& out);
  void take_by_end(int segment, const Pull&, const std::vector<double>& depth, const Occupied&, std::int64_t& next_id,
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
