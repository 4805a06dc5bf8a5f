#pragma once
// The exchange between the solver and the engine around one zone, window by window:
//
//   impose(solver)     what rafts drew in and grains gave back in the last window becomes the rim's fluxes
//   ... the solver steps to the window's end ...
//   request(solver)    what really passed is owed to the conveyors, which send grains; the flow outside sets the rafts' push
//   ... the engine advances ...
//   absorb(advanced)   grains that left are handed back; the covered cells show the grains' depth and velocity
//
// Precedence: impose < solver < request < engine < absorb < next impose. Each transfer lags by one window; what is on its way is
// in the ledger (`faces_mass`). At a segment that the flow does not clearly leave, the raft (grain_engine.hpp) moves under the
// grains' forces and the push of the flow that it dams up: the mirrored Riemann problem of (h, u - u_raft), with the flow's own
// K; along the face it slides with the flow.

#include <algorithm>
#include <vector>

#include "coupling/transfer/airborne.hpp"
#include "coupling/transfer/coarse_grain.hpp"
#include "coupling/transfer/conveyor.hpp"
#include "coupling/transfer/handback.hpp"

namespace couloir {

struct ZoneSettings {
  CellBox box;
  RimSettings rim;
  double gravity = 9.81;  // [m/s2]
  bool periodic_y = false;
  std::int64_t first_id = 1;  // of its grains
};

class Zone {
 public:
  Zone(const ZoneSettings&, const Grid&, const ReferenceSurface&, const PackingTable&);

  // The zone takes over: its cells' material becomes grains (to a few grains; the rest is owed), the solver's cells are covered.
  // Returns the grains to insert before the first window.
  std::vector<NewGrain> take_over(Solver&);

  // This zone goes on for `before`, whose engine holds `grains`, with another box; to be called between two windows, on a new
  // zone. Newly covered material becomes grains cut from the settled
  // packing with the flow's depth and velocity, where none stand yet; grains of cells that open become their flow. The next
  // request tells the engine. Keeps: mass to round-off; momentum of what changes sides but for parcels on their way.
  struct Moved {
    double covered = 0, opened = 0;  // [kg] of flow that became grains, of grains that became flow
    long filled = 0, freed = 0;      // grains new, gone
    double left_over = 0;            // [kg] what whole grains could not carry, now owed to the faces
  };
  Moved take_from(const Zone& before, const Grains& grains, Solver&);

  // The solver's cells are its own again, empty.
  void give_up(Solver&);

  // The window that begins: engine steps, and their length [s].
  void begin_window(std::int64_t steps, double length) { steps_ = steps, window_ = length; }
  void impose(Solver&);
  AdvanceRequest request(Solver&);
  void absorb(const Advanced&, Solver&, Airborne* = nullptr);  // null: what flies lands in the cell next to the face
  void take_out(const std::vector<std::int64_t>& ids);  // grains that have left the domain: no longer counted, removed next

  const Rim& rim() const { return rim_; }
  bool is_counted(std::int64_t id) const { return !handback_.is_shadow(id) && !is_driven(id); }
  double faces_mass() const;                    // [kg] owed by conveyors, on its way to the continuum
  double faces_momentum() const;                // [N s] along x
  double grains_mass(const Grains&) const;      // [kg] of those that count: neither shadows nor driven
  double grains_momentum(const Grains&) const;  // [N s] along x, of those
  long inserted() const { return inserted_; }
  long returned() const { return handback_.returned(); }
  const CoarseGrained& field() const { return field_; }
  const CellBox& box() const { return settings_.box; }
  // Along a face, cell by cell: how fast [m/s] the flow outside comes in, 0 where no raft draws it, and what the grains do
  // `cells` further in.
  struct Look {
    double outside, inside;  // [m/s] along the inward normal
    double depth;            // [m] outside
    double froude;           // outside, of the normal velocity
  };
  std::vector<Look> look(const Solver&, const RimFace&, int cells) const;
  // Whether flow of half a diameter or more comes towards a face, at a tenth of sqrt(g d) or more.
  bool flow_comes(const Solver&);
  std::int64_t next_id() const { return next_id_; }
  const std::vector<NewGrain>& to_insert() const { return move_fill_; }  // with the next request, after a move
  // At rest, without an engine: the covered cells show the grains, still, and what comes meets the faces as walls. In place of
  // request and absorb: count_passed.
  void rest(const Grains&, Solver&);
  void wake();
  bool awaits_removal(std::int64_t id) const { return std::binary_search(remove_.begin(), remove_.end(), id); }
  std::vector<std::vector<double>> count_passed(const Solver&);
  // Between two windows; into a zone of the same settings. The solver's covered cells are the solver's.
  void state(Archive& a) {
    a(conveyors_, handback_, segments_, imposed_, field_, remove_, layer_, beside_, remainder_, next_id_, steps_, window_,
      inserted_, fresh_, own_from_, closed_, covered_, slide_, slid_, face_of_driven_);
  }

 private:
  struct Segment {                            // of a face: what the flow outside does there
    bool inflow = false;                      // a raft stands there: the flow comes in, or grazes a face that slides
    bool fast_outflow = false;                // normal Froude number above 2
    double depth = 0, normal = 0, along = 0;  // [m], [m/s] inward: all inflow of the face together, [m/s]
    double comes = 0;                         // [m/s] inward, of this segment alone
    double raft = 0, displacement = 0;        // [m/s], [m] of the last window
    double held = 0;                          // [m] how far the raft stands behind where it has been
    double rate = 0;                          // [m/s] at which the raft draws the flow in
  };
  void look_outside(const Solver&);
  FlowState outside(const Solver&, const RimFace&, int k) const;  // next to the face's cell k
  // [m] Thinner than this, a flow carries no grains worth sending: a hundredth of a diameter.
  double least_depth() const { return 0.01 * settings_.rim.diameter; }
  bool carried(const RimFace&, const Segment&, double normal, double along) const;  // by a raft
  bool open_end(int face, int segment) const;  // no raft stands beyond the end from which the segment slides
  void share_out(double mass);                 // [kg] that is left over, among what the faces owe
  double weight(int face, int k) const;        // [m/s2] of the flow on its bed outside of cell k
  double push(const Solver&, int face, int k, double raft, double weight) const;  // [m3/s2] per unit width and density
  double push_on_grains(const Solver&, int face, int k, double raft) const;
  void feed(const Solver&, int face, int segment, double given, const std::vector<double>& depth, std::vector<NewGrain>&);
  void drive_raft(const Solver&, int face, int segment, SegmentDrive&) const;
  void drive_strip(const Solver&, int face, int segment, SegmentDrive&) const;  // of shadows
  void find_layer(const Grains&);
  void show(const Grains&, Solver&, bool moving);                                     // in the covered cells
  double layer_due(const Solver&, int face, int segment) const;                       // [kg] Conveyor::Pull
  double outside_depth(const Solver&, const RimFace&, int k, double distance) const;  // [m] of the flow, [m] before the face
  void note_released(const Grains&);
  void let_go_of_layer();
  void take_from_layer(const NewGrain&);
  void thin_out_layer();
  double period() const { return settings_.periodic_y ? grid_.ny * grid_.dy : 0; }  // [m] along y; 0: none
  double across(double dy) const;                                                   // [m] the nearest of its periodic images
  void note_driven(const NewGrain&);
  bool is_driven(std::int64_t id) const { return id < std::int64_t(face_of_driven_.size()) && face_of_driven_[id] >= 0; }
  bool is_where_layers_come(const Vec&) const;        // elsewhere than at the plane, where no free grain is
  double speed_along_x(int face, double raft) const;  // [m/s] of a driven layer
  Conveyor::Occupied occupied(int face, const std::vector<NewGrain>& inserted) const;
  friend class RimMover;  // zone_move.cpp

  static constexpr double steepest_ = 0.5;  // least ratio of normal to tangential velocity that a raft carries in ...
  static constexpr double grazes_ = -0.01, leaves_ = -0.05;  // ... that slides along its face: to begin, to go on

  ZoneSettings settings_;
  Grid grid_;
  const ReferenceSurface* surface_;
  const PackingTable* table_;
  Rim rim_;
  std::vector<Conveyor> conveyors_;
  Handback handback_;
  std::vector<std::vector<Segment>> segments_;
  std::vector<std::vector<double>> imposed_;  // [face][cell] inward [m2/s] drawn in by rafts in this window
  CoarseGrained field_;
  std::vector<std::int64_t> remove_;
  std::vector<NewGrain> layer_;   // driven grains after the last window
  std::vector<NewGrain> beside_;  // free grains where new ones may come, for it, too
  double remainder_ = 0;          // [kg] left over from filling with whole grains
  std::int64_t next_id_ = 1, steps_ = 0;
  double window_ = 0;  // [s]
  long inserted_ = 0;
  bool fresh_ = false;                       // no window yet
  bool closed_ = false;                      // at rest
  int covered_ = -1;                         // the solver's number of the zone
  std::vector<double> slide_, slid_;         // [face] of its rafts along it [m/s], in the last window [m]
  std::vector<signed char> face_of_driven_;  // by id; -1: not driven
  std::int64_t own_from_ = 0;                // driven grains below this id were not laid by the conveyors that stand there now
  std::vector<RimMove> move_;                // to tell the engine
  std::vector<NewGrain> move_fill_;          // with it
};

}  // namespace couloir
