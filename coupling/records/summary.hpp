#pragma once
// RUN/summary.json: the run in a page. Keys are a contract (docs of the verbs); all SI. Written when the run ends, in whatever
// state: status "done", "interrupted" or "failed", with the reason.
//
//   status, reason; title, scene, mode, revision, instruction_set (continuum/isa), engine, bulk_density
//   time      .simulated, .wall, .cpu [s]; .cpu_continuum, .cpu_engine, .cpu_coupling [s] and .share_* of cpu [-]
//   mass      .initial, .final, .left_domain, .entered, .overtopped [kg]; .relative_error, the largest of all windows
//             final: what is still in the domain: continuum + grains + faces + airborne
//   momentum  .relative_residual: largest |residual| / scale of all windows
//   continuum .cells, of all sizes at the end; .levels [{level, cell [m], blocks, cells}], the same by size, empty: of one size
//             .steps, .cell_updates, .cell_updates_per_second (of cpu_continuum), .min_depth [m] (null: no continuum),
//             .refinement_drift [kg]: what plain copying between refined grids has won (noc); not part of mass.relative_error
//   grains    .inserted, .returned, .peak_count, .steps, .particle_steps, .particle_steps_per_second (of cpu_engine),
//             .max_overlap
//   obstacles.<name> .force_peak, .force_peak_time, .force_peak_window, .force_mean, .force_final, .first_contact (null: never),
//             .impulse, .impulse_across: of the component along the slope, defined in force_series.hpp
//             .max_depth_on_top, .depth_on_top_final [m]: greatest depth on its top, over the run and at the end; of
//             grains alone: means over squares of two diameters
//             method planes also: .overflow [kg] over its upper edges, .max_heap [m] on the slope along its foot, .max_climbed
//             [m]
//   obstacles.<name>.gauges.<gauge> .area [m2]; .first_contact (null: never); of the stresses normal, shear_up and shear_across
//             .<stress>_peak of the 15 ms mean, ._peak_time, ._mean since the first contact, ._final of the last 50 ms [Pa],
//             ._impulse [Pa s]; null where no grains meet the obstacle (loop/stress_gauges.hpp)
//   gauges.<name> .max_depth, .max_depth_time, .depth_final, .depth_mean, .velocity_mean, .max_speed, .arrival (null: never):
//             gauge_series.hpp; arrived is a flow of 1 % of the greatest depth of release and inflows; none in grains mode
//   obstacles.<name>.<kind>, walls.<side>  the force by other measures (loop/force_measures.hpp): .maximum, the largest window's
//             mean [N]; .peak and .peak_time of the 15 ms mean; .mean over the whole run, .final of the last 50 ms [N]; .impulse
//             [N s]. Of the component along the slope, and .impulse_across; of a wall the component out of the domain
//   obstacles_together  along the slope, all obstacles as one (docs/forces.md); absent where there are none:
//             .own, .control_volume: .force_peak and .force_peak_time of the 15 ms mean, .force_mean over the whole run [N],
//             .impulse [N s]; .difference, of the second less the first: .largest and .largest_time of the 15 ms mean, .mean [N],
//             .relative: |largest| over the own |force_peak|, null where that is 0
//   coupling_noise  absent in continuum mode and without obstacles: .window_frequency, .sampling_frequency [Hz];
//             .peak_over_neighbours, that of the obstacle where it is largest (null: no series is long enough);
//             .obstacles.<name>.peak_over_neighbours, .between_harmonics, .rms [N], .resolution [Hz], .segments (null: likewise,
//             or no grains meet it), .harmonics [{frequency, peak_over_neighbours, between_harmonics}]: coupling_noise.hpp,
//             from the first contact on
//   flow      .max_speed [m/s]
//   costs     [{part, effect, seconds, share}]: time.cpu by what took it; effect: that alone asks for this part (null: none)
//             seconds of processor time; share of time.cpu. The solver's parts: continuum/scheme/step_parts.hpp; flights, engine,
//             set_up, exchange (coupled, with the ledgers) or ledgers, records, checkpoints, closing
//   effects   [{name, on, reason}];  events [{time, what}]
//   resumed   [{time, reason}]: where the run went on from a checkpoint

#include <string>
#include <vector>

#include "coupling/loop/observer.hpp"
#include "coupling/records/coupling_noise.hpp"
#include "coupling/records/force_series.hpp"
#include "coupling/records/gauge_series.hpp"

namespace couloir {

class Summary : public Observer {
 public:
  explicit Summary(const std::string& path);
  void on_start(const RunStart&) override;
  void on_window(const WindowReport&) override;
  void on_event(const Event&) override;
  void state(Archive&) override;
  void on_resume(const Resumption& r) override { resumptions_.push_back(r); }
  void on_finish(const RunEnd&) override;  // writes the file; throws RecordError

  std::string text() const { return text_; }  // what was written; empty before on_finish
  std::string made(const RunEnd&) const;      // what would be, now

 private:
  void take(const WindowReport&);
  void take_measures(const WindowReport&);
  void take_stresses(const WindowReport&);
  void take_samples(const WindowReport&);
  std::vector<std::optional<CouplingNoise>> noises() const;  // by obstacle

  struct Obstacle {
    std::string name;
    ForceSeries along;
    double impulse_across = 0, max_depth = 0, depth_final = 0;
    std::vector<double> samples;  // [N] of the force along the slope
    bool met = false;             // by grains
    void state(Archive& a) { a(along, impulse_across, max_depth, depth_final, samples, met); }
  };
  struct Gauge {
    std::string name;
    GaugeSeries series;
    void state(Archive& a) { a(series); }
  };

  struct Stresses {
    StressGauge what;
    ForceSeries normal, up, across;  // [Pa]
    void state(Archive& a) { a(normal, up, across); }
  };

  struct Measure {
    ForceMeasure what;
    ForceSeries series;
    double impulse_across = 0;
    void state(Archive& a) { a(series, impulse_across); }
  };

  std::string path_, text_;
  std::string title_, scene_, mode_, engine_;
  double bulk_density_ = 0;
  bool has_continuum_ = false;
  long cells_ = 0;
  std::vector<Obstacle> obstacles_;
  int planes_ = -1;  // number of the one that is made of planes
  double overflow_ = 0, max_heap_ = 0, max_climbed_ = 0;
  ForceSeries together_, by_control_volume_, difference_;
  double window_ = 0, sample_interval_ = 0;  // [s]
  std::vector<Gauge> gauges_;
  std::vector<Measure> measures_;
  std::vector<Stresses> stresses_;
  std::vector<std::pair<std::string, std::string>> unread_;  // gauges that no grains meet: obstacle, name
  std::vector<Effect> effects_;
  std::vector<Event> events_;
  std::vector<Resumption> resumptions_;
  WindowReport last_;
  double mass_error_ = 0, residual_ = 0, min_depth_ = 0, max_overlap_ = 0, max_speed_ = 0;
  long peak_grains_ = 0;
};

}  // namespace couloir
