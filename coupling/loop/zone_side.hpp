#pragma once
// One zone of a coupled run: its exchange with the solver, its engine, and its life:
//
//             flow within reach             all at rest
//   waiting ---------------------> running -------------> resting: the grains lie as deposit, no engine
//      ^                            |   ^                    |
//      +------- no grain left ------+   +---- flow comes ----+
//
// While it runs it may grow and shrink (zone_watch.hpp). Every change is an event with its reason and its numbers.
//
//   begin_window   starts, moves, ends; then what rafts drew in and grains gave back becomes the rim's fluxes
//   ... the solver steps ...
//   ask            what really passed becomes the engine's request
//   advance        the engine alone: zones may do so at the same time
//   take_back      what it gave back
//   report         into the window's ledgers

#include <functional>
#include <memory>

#include "coupling/checkpoint/archive.hpp"
#include "coupling/loop/flow_side.hpp"
#include "coupling/loop/grain_side.hpp"
#include "coupling/loop/zone_watch.hpp"
#include "coupling/plan/zone.hpp"
#include "coupling/transfer/domain_edge.hpp"
#include "coupling/transfer/zone.hpp"

namespace couloir {

class ZoneSide {
 public:
  using Tell = std::function<void(double time, const std::string& what)>;

  // deepest [m]: the flow that its packing must be cut for.
  // `work_dir`: of its engine.
  ZoneSide(const Scene&, const RunOptions&, const std::string& work_dir, const ReferenceSurface&, FlowSide&, const PlannedZone&,
           double deepest, Tell);

  double timestep() const { return grains_->timestep(); }  // [s]
  CellBox widest() const { return watch_->widest(); }      // that it may grow to
  CellBox box() const { return watch_->box(); }
  bool covers() const { return zone_ != nullptr; }
  bool holds(int obstacle) const { return zone_ && grains_->has_obstacle(obstacle); }
  const Grains* grains() const { return zone_ ? &grains_->last().grains : nullptr; }
  const std::vector<StressGauge>& gauges() const { return gauges_; }
  const GrainSide& grain_side() const { return *grains_; }
  GrainEngine* engine() { return grains_->running() ? &grains_->port() : nullptr; }

  // `time` [s]: at the window's begin.
  void begin_window(double time, std::int64_t steps, double length);
  void ask();
  void advance();
  void take_back();
  // Adds the zone's terms to the ledgers and counters.
  void report(WindowReport&);
  double momentum() const { return momentum_; }  // [N s] along x, of what the zone holds

  // `checkpoint`: the engine's, where one was running.
  void state(Archive&, const std::string& checkpoint);

 private:
  bool flow_is_near() const;
  ZoneSettings settings() const;
  EngineSetup setup() const;
  std::unique_ptr<Zone> new_zone() const;
  void start();
  void wake();
  void rest();
  void end();
  void move(const ZoneWatch::Move&);
  void follow();
  void take_stock();

  const Scene& scene_;
  const RunOptions& options_;
  const ReferenceSurface& surface_;
  FlowSide& flow_;
  PlannedZone planned_;
  Tell tell_;
  std::unique_ptr<GrainSide> grains_;
  std::unique_ptr<ZoneWatch> watch_;
  std::unique_ptr<Zone> zone_;
  std::unique_ptr<DomainEdge> edge_;
  std::vector<StressGauge> gauges_;
  Eigen::Vector3d along_;  // the slope in the zone
  std::string work_dir_;
  std::vector<NewGrain> first_;  // with the next advance
  AdvanceRequest request_;
  std::int64_t steps_ = 0, next_id_ = 1;
  double time_ = 0, length_ = 0;                        // [s] of this window: its begin, its length
  double mass_ = 0, momentum_ = 0, left_momentum_ = 0;  // at the last report
  double left_over_ = 0;                                // [kg] on the faces of zones that have ended
  long inserted_ = 0, returned_ = 0;                    // by them
};

}  // namespace couloir
