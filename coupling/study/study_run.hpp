#pragma once
// Makes the runs of a study, as many at a time as jobs allow, and gathers what its table shows.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "coupling/cases/run_pool.hpp"
#include "coupling/study/study.hpp"

namespace couloir {

struct StudyResult {
  enum class Status { waiting, done, failed } status = Status::waiting;  // waiting: stopped before it was done
  std::string reason;                                                    // of a failure, or what else to know; one sentence
  std::vector<double> values, mean, scatter;                             // as StudyRow::quantities, in their units; NaN: none
  int replicates = 0;                                                    // done rows of its group, of which mean and scatter are
  int runs = 0;                                                          // made for it, or found done
  double cpu = 0, wall = 0;                                              // [s] of all these, when they were made
  double cell_updates = 0, particle_steps = 0;
  std::string run, hash, command;        // of a search: at its critical value
  double seconds = 0;                    // that it took now
  std::map<std::string, double> cpu_of;  // [s] of these, by folder
};
const char* to_string(StudyResult::Status);

struct StudyProgress {
  std::size_t done = 0, of = 0;  // rows
  double left = 0;               // [s] estimated by the plan and by what the rows took so far
};

struct StudySettings {
  int jobs = 1;
  std::function<bool()> stop = [] { return false; };
  // When a row is done or has failed; one at a time.
  std::function<void(const StudyRow&, const StudyResult&, const StudyProgress&)> on_row = [](const auto&, const auto&,
                                                                                             const auto&) {};
  std::function<void(const StudyProgress&)> tick = [](const auto&) {};  // in between, some times a second
};

// As the study's rows. A run that fails is a row that failed; the others go on.
std::vector<StudyResult> run_study(const Study&, RunPool&, const StudySettings&);

// [s] of all runs, each once, whichever rows share it.
double total_cpu(const std::vector<StudyResult>&);

// Mean and scatter (the standard deviation of a sample, n - 1; NaN for less than two) over the done rows of each group.
void add_replicates(const Study&, std::vector<StudyResult>&);

}  // namespace couloir
