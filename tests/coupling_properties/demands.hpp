#pragma once
// What every coupled run must keep, looked at after each window. Nothing is asserted here: the worst of each is kept, with the
// first window in which a demand was broken.

#include <string>
#include <vector>

#include "coupling/loop/observer.hpp"

namespace couloir {

class Demands : public Observer {
 public:
  void on_start(const RunStart&) override;
  void on_window(const WindowReport&) override;
  void on_frame(const FrameView&) override;
  void on_finish(const RunEnd&) override;

  const std::vector<std::string>& broken() const { return broken_; }

  struct Worst {
    double mass = 0;           // [-] relative error of the ledger
    double residual = 0;       // [-] of a window's momentum over the run's largest
    double overlap = 0;        // [d]
    double overlap_share = 0;  // of what its speed allows
    double grain_energy = 0;   // [-] kinetic over what its drop can have given, per grain
    double flow_energy = 0;    // [-] the same per cell
    double fastest = 0;        // [m/s] of a grain
    long most_grains = 0;
    long windows = 0;
  };
  const Worst& worst() const { return worst_; }

 private:
  void demand(bool holds, double time, const std::string& what);
  void look_at_grains(const FrameView&);
  void look_at_flow(const FrameView&);
  double given(double level) const;  // [m2/s2] twice the energy that a kilogram has, from its start to this level

  const Scene* scene_ = nullptr;
  const ReferenceSurface* surface_ = nullptr;
  Grid grid_;
  std::vector<double> bed_;
  double top_ = 0, start_ = 0;  // [m] highest level of material, [m/s] its fastest start
  double front_ = 0;            // [m/s] of the fastest front on level ground
  double residual_ = 0, residual_time_ = 0, momentum_ = 0;  // [N s], [s]: the largest; [N s] the largest momentum
  bool finished_ = false;
  Worst worst_;
  std::vector<std::string> broken_;
};

}  // namespace couloir
