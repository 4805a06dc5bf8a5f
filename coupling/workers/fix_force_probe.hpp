#pragma once
// Forces of the grains on each surface. The engine allows a single fix for all surfaces but counts the force on each mesh; a
// probe before that fix clears the counts and one behind it reads them, step by step and on each rank for itself.

#include <vector>

#include "coupling/engine/grain_engine.hpp"
#include "coupling/workers/engine_headers.hpp"

namespace couloir {

// A mesh's count of the force [N] on it by this rank's grains.
double* mesh_force(LAMMPS_NS::LAMMPS*, const std::string& mesh);

class FixForceProbe : public LAMMPS_NS::Fix {
 public:
  FixForceProbe(LAMMPS_NS::LAMMPS*, int, char**);  // fix ID all couloir/probe clear|read
  void set_meshes(std::vector<double*> counts);
  int setmask() override;
  void setup(int) override;
  void post_force(int) override;

  void begin_window(std::int64_t sample_steps);  // 0: no samples
  // [N] on surface k: mean over the window, weighted as velocity Verlet kicks (both ends by half), so that the mean times the
  // window is the momentum given.
  Vec mean(std::size_t k) const;
  Vec last(std::size_t k) const { return now_[k]; }
  // [N] on surface k: means over sample_steps steps each, weighted likewise, so that their mean is that of the window.
  const std::vector<Vec>& samples(std::size_t k) const { return samples_[k]; }

 private:
  void act();
  void end_sample();
  bool reads_ = false;
  std::vector<double*> counts_;
  std::vector<Vec> first_, now_, sum_;
  std::vector<Vec> sample_first_, sample_sum_;  // of the sample that is being taken
  std::vector<std::vector<Vec>> samples_;
  std::int64_t steps_ = 0, sample_steps_ = 0;
};

}  // namespace couloir
