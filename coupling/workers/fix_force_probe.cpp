#include "coupling/workers/fix_force_probe.hpp"

// clang-format off
#include <liggghts/fix_mesh_surface.h>
#include <liggghts/mesh_module_stress.h>
// clang-format on

#include "coupling/workers/register_fix.hpp"

namespace couloir {

double* mesh_force(LAMMPS_NS::LAMMPS* engine, const std::string& mesh) {
  auto* module =
      dynamic_cast<LAMMPS_NS::MeshModuleStress*>(find_fix<LAMMPS_NS::FixMeshSurface>(engine, mesh)->get_module("stress"));
  if (!module) throw std::logic_error("the engine does not count the force on " + mesh);
  return module->f_total_ptr();
}

FixForceProbe::FixForceProbe(LAMMPS_NS::LAMMPS* lmp, int n, char** words) : Fix(lmp, n, words) {
  if (n != 4) error->all(FLERR, "fix couloir/probe needs clear or read");
  reads_ = std::string(words[3]) == "read";
}

void FixForceProbe::set_meshes(std::vector<double*> counts) {
  counts_ = std::move(counts);
  first_.resize(counts_.size());
  now_.resize(counts_.size());
  sum_.resize(counts_.size());
  sample_sum_.resize(counts_.size());
  samples_.resize(counts_.size());
}

int FixForceProbe::setmask() {
  return LAMMPS_NS::FixConst::POST_FORCE;
}

void FixForceProbe::setup(int) {
  act();
}

void FixForceProbe::post_force(int) {
  act();
  ++steps_;
  for (std::size_t m = 0; m < now_.size(); ++m) {
    for (int k = 0; k < 3; ++k) sum_[m][k] += now_[m][k], sample_sum_[m][k] += now_[m][k];
  }
  if (sample_steps_ > 0 && steps_ % sample_steps_ == 0) end_sample();
}

void FixForceProbe::end_sample() {
  for (std::size_t m = 0; m < now_.size(); ++m) {
    Vec mean;
    for (int k = 0; k < 3; ++k)
      mean[k] = (sample_sum_[m][k] + 0.5 * (sample_first_[m][k] - now_[m][k])) / static_cast<double>(sample_steps_);
    samples_[m].push_back(mean);
  }
  sample_first_ = now_;
  std::fill(sample_sum_.begin(), sample_sum_.end(), Vec{});
}

void FixForceProbe::act() {
  for (std::size_t m = 0; m < counts_.size(); ++m) {
    for (int k = 0; k < 3; ++k) {
      if (reads_) {
        now_[m][k] = counts_[m][k];
      } else {
        counts_[m][k] = 0;
      }
    }
  }
}

void FixForceProbe::begin_window(std::int64_t sample_steps) {
  first_ = sample_first_ = now_;
  sample_steps_ = sample_steps;
  std::fill(sum_.begin(), sum_.end(), Vec{});
  std::fill(sample_sum_.begin(), sample_sum_.end(), Vec{});
  for (std::vector<Vec>& all : samples_) all.clear();
  steps_ = 0;
}

Vec FixForceProbe::mean(std::size_t m) const {
  if (steps_ == 0) return now_[m];
  Vec mean;
  for (int k = 0; k < 3; ++k) mean[k] = (sum_[m][k] + 0.5 * (first_[m][k] - now_[m][k])) / static_cast<double>(steps_);
  return mean;
}

}  // namespace couloir
