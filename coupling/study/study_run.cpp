#include "coupling/study/study_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "coupling/cases/scatter.hpp"
#include "coupling/cases/share_out.hpp"
#include "coupling/cases/summary_value.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

StudyResult blank(const StudyRow& row) {
  StudyResult out;
  out.values.assign(row.quantities.size(), nan);
  out.mean = out.scatter = out.values;
  return out;
}

double shown(const nlohmann::json& summary, const StudyQuantity& q, const std::string& place) {
  return summary_value(summary, q.path, place) / q.unit.si;
}

// Of a row that needs no run.
StudyResult known_result(const StudyRow& row) {
  StudyResult out = blank(row);
  out.status = StudyResult::Status::done;
  out.cpu = summary_value(*row.known, "time.cpu", row.place);
  out.wall = summary_value(*row.known, "time.wall", row.place);
  for (std::size_t k = 0; k < row.quantities.size(); ++k) out.values[k] = shown(*row.known, row.quantities[k], row.place);
  return out;
}

StudyResult result_of(const StudyRow& row, RunPool& pool) {
  if (row.known) return known_result(row);
  StudyResult out = blank(row);
  const CaseOutcome outcome = run_case(row, pool);
  for (const PooledRun& run : outcome.runs) {
    ++out.runs;
    out.seconds += run.seconds;
    if (!run.failure.empty()) continue;
    out.cpu += out.cpu_of[run.folder] = summary_value(run.summary, "time.cpu", row.place);
    out.wall += summary_value(run.summary, "time.wall", row.place);
    out.cell_updates += summary_value(run.summary, "continuum.cell_updates", row.place);
    out.particle_steps += summary_value(run.summary, "grains.particle_steps", row.place);
  }
  out.run = outcome.run.folder, out.hash = outcome.run.hash, out.command = outcome.run.command;
  out.reason = outcome.failure.empty() ? outcome.remark : outcome.failure;
  out.status = outcome.failure.empty() ? StudyResult::Status::done : StudyResult::Status::failed;
  if (out.status == StudyResult::Status::failed) {
    out.run.clear();  // there is none of that name
    return out;
  }
  for (std::size_t k = 0; k < row.quantities.size(); ++k) {
    const StudyQuantity& q = row.quantities[k];
    out.values[k] = q.path == "critical"
                        ? outcome.critical * (row.search->unit.empty() ? 1 : parse_case_unit(row.search->unit).si / q.unit.si)
                        : shown(outcome.run.summary, q, row.place);
  }
  return out;
}

// What is left, from the plan's seconds and how long a second of the plan has taken so far.
class Estimate {
 public:
  Estimate(const std::vector<StudyRow>& rows, int jobs) : jobs_(jobs) {
    for (const StudyRow& row : rows) waiting_ += row.planned;
    progress_.of = rows.size();
  }
  void begin(std::size_t k, const StudyRow& row) {
    waiting_ -= row.planned;
    running_[k] = {Clock::now(), row.planned};
  }
  void end(std::size_t k, bool made) {
    const auto [since, planned] = running_[k];
    running_.erase(k);
    ++progress_.done;
    if (!made) return;
    planned_ += planned;
    took_ += std::chrono::duration<double>(Clock::now() - since).count();
  }
  StudyProgress now() const {
    const double factor = planned_ > 0 ? took_ / planned_ : 1;
    StudyProgress out = progress_;
    double work = std::max(0.0, waiting_) * factor, longest = 0;
    for (const auto& [k, one] : running_) {
      const double left = std::max(0.0, one.second * factor - std::chrono::duration<double>(Clock::now() - one.first).count());
      work += left;
      longest = std::max(longest, left);
    }
    out.left = std::max(longest, work / jobs_);
    return out;
  }

 private:
  int jobs_;
  double waiting_ = 0, planned_ = 0, took_ = 0;
  std::map<std::size_t, std::pair<Clock::time_point, double>> running_;
  StudyProgress progress_;
};

}  // namespace

const char* to_string(StudyResult::Status status) {
  switch (status) {
    case StudyResult::Status::waiting:
      return "not run";
    case StudyResult::Status::done:
      return "done";
    case StudyResult::Status::failed:
      return "failed";
  }
  return "?";
}

std::vector<StudyResult> run_study(const Study& study, RunPool& pool, const StudySettings& settings) {
  std::vector<StudyResult> results;
  for (const StudyRow& row : study.rows) results.push_back(blank(row));
  std::mutex mutex;
  Estimate estimate(study.rows, settings.jobs);
  share_out(
      study.rows.size(), settings.jobs,
      [&](std::size_t k) {
        const StudyRow& row = study.rows[k];
        {
          const std::lock_guard lock(mutex);
          estimate.begin(k, row);
        }
        StudyResult one = blank(row);
        try {
          one = result_of(row, pool);
        } catch (const SceneError& error) {  // a value inside a search's ends that the scene refuses, a number that is not there
          one.status = StudyResult::Status::failed;
          one.reason = error.what();
        } catch (const nlohmann::json::exception& error) {  // a summary that is not of this program's form
          one.status = StudyResult::Status::failed;
          one.reason = fmt::format("{}: a run's summary.json is damaged: {}", row.place, error.what());
        }
        const std::lock_guard lock(mutex);
        estimate.end(k, one.seconds > 0);
        results[k] = one;
        settings.on_row(row, one, estimate.now());
      },
      settings.stop,
      [&] {
        const std::lock_guard lock(mutex);
        settings.tick(estimate.now());
      });
  add_replicates(study, results);
  return results;
}

double total_cpu(const std::vector<StudyResult>& results) {
  std::map<std::string, double> once;
  for (const StudyResult& r : results) once.insert(r.cpu_of.begin(), r.cpu_of.end());
  double sum = 0;
  for (const auto& [folder, cpu] : once) sum += cpu;
  return sum;
}

void add_replicates(const Study& study, std::vector<StudyResult>& results) {
  std::map<int, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < study.rows.size(); ++k)
    if (results[k].status == StudyResult::Status::done) groups[study.rows[k].group].push_back(k);
  for (const auto& [group, members] : groups) {
    for (std::size_t q = 0; q < study.rows[members.front()].quantities.size(); ++q) {
      std::vector<double> values;
      for (const std::size_t k : members) values.push_back(results[k].values[q]);
      const Scatter s = scatter_of(values);
      for (const std::size_t k : members) {
        results[k].replicates = static_cast<int>(members.size());
        results[k].mean[q] = s.mean;
        results[k].scatter[q] = s.scatter;
      }
    }
  }
}

}  // namespace couloir
