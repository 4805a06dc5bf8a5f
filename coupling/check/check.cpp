#include "coupling/check/check.hpp"

#include <limits>
#include <mutex>

#include "coupling/cases/case_run.hpp"
#include "coupling/cases/share_out.hpp"
#include "coupling/cases/summary_value.hpp"
#include "coupling/check/check_text.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

struct Task {
  const Expected* experiment;
  const CheckCase* one;
};

Finding blank(const Task& task, const Expectation& e) {
  Finding f;
  f.experiment = experiment_name(task.experiment->folder);
  f.name = task.one->name;
  f.variant = task.one->variant;
  f.expectation = e;
  f.value = f.deviation = std::numeric_limits<double>::quiet_NaN();
  return f;
}

void fail(std::vector<Finding>& findings, const std::string& reason) {
  for (Finding& f : findings) f.verdict = Verdict::fail, f.reason = reason;
}

std::vector<Finding> judged(const Task& task, RunPool& pool) {
  const CheckCase& c = *task.one;
  std::vector<Finding> findings;
  for (const Expectation& e : c.expect) findings.push_back(blank(task, e));
  if (c.skipped) return findings;
  const CaseOutcome outcome = run_case(c, pool);
  for (Finding& f : findings) {
    if (c.search) {
      judge(f, outcome.critical * f.expectation.unit.si);
    } else {
      f.run = outcome.run.folder, f.command = outcome.run.command;
      if (outcome.failure.empty()) judge(f, summary_value(outcome.run.summary, f.expectation.quantity, f.expectation.place));
    }
  }
  if (!outcome.failure.empty()) fail(findings, outcome.failure);
  return findings;
}

}  // namespace

std::vector<Finding> check_experiments(const std::vector<Expected>& experiments, RunPool& pool, const std::string& materials,
                                       const CheckSettings& settings) {
  std::vector<Task> tasks;
  for (const Expected& e : experiments)
    for (const CheckCase& c : e.cases) tasks.push_back({&e, &c});
  for (const Task& task : tasks)
    if (!task.one->skipped) scenes_of(*task.one, materials);

  std::vector<std::vector<Finding>> results(tasks.size());
  std::mutex mutex;
  share_out(
      tasks.size(), settings.jobs,
      [&](std::size_t k) {
        const std::vector<Finding> found = judged(tasks[k], pool);
        const std::lock_guard lock(mutex);
        results[k] = found;
        settings.on_case(found);
      },
      settings.stop);

  std::vector<Finding> all;
  for (std::vector<Finding>& part : results) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace couloir
