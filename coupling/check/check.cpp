#include "coupling/check/check.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <mutex>
#include <thread>

#include "coupling/check/check_text.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {
namespace {

struct Task {
  const Expected* experiment;
  const CheckCase* one;
};

// Steps such as 0.1 do not add up exactly; the text is what the file would say.
std::string value_text(const Search& search, double value) {
  return fmt::format("{:.10g}{}{}", value, search.unit.empty() ? "" : " ", search.unit);
}

Overrides with(Overrides set, const Search& search, double value) {
  const std::string text = value_text(search, value);
  const auto at = search.form.find("{}");
  set.emplace_back(search.key, search.form.substr(0, at) + text + search.form.substr(at + 2));
  return set;
}

long steps_of(const Search& search) {
  return std::lround(std::floor((search.to - search.from) / search.step + 1e-9));
}

double last_value(const Search& search) {
  return search.from + static_cast<double>(steps_of(search)) * search.step;
}

// The scenes that a case will run, read now so that an error in one of them comes before hours of work.
void read_scenes(const CheckCase& c, const std::string& materials) {
  try {
    if (!c.search) {
      read_scene(c.scene, materials, c.set);
    } else {
      for (const double end : {c.search->from, c.search->to}) read_scene(c.scene, materials, with(c.set, *c.search, end));
    }
  } catch (const SceneError& error) {
    throw SceneError(fmt::format("{}: {}: {}", c.place, c.name, error.what()));
  }
}

std::string name_of(const Expected& experiment) {
  auto folder = std::filesystem::absolute(experiment.folder).lexically_normal();
  return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

Finding blank(const Task& task, const Expectation& e) {
  Finding f;
  f.experiment = name_of(*task.experiment);
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
  if (!c.search) {
    const CheckedRun run = pool.run(c.scene, c.set);
    for (Finding& f : findings) {
      f.run = run.folder, f.command = run.command;
      if (run.failure.empty()) judge(f, summary_value(run.summary, f.expectation.quantity, f.expectation.place));
    }
    if (!run.failure.empty()) fail(findings, run.failure);
    return findings;
  }
  std::string failure;
  const auto quantity_at = [&](double at) {
    const CheckedRun run = pool.run(c.scene, with(c.set, *c.search, at));
    failure = run.failure;
    return failure.empty() ? summary_value(run.summary, c.search->quantity, c.place) : std::numeric_limits<double>::quiet_NaN();
  };
  const double value = smallest_good(
      *c.search, [&](double at) { return failure.empty() && quantity_at(at) <= c.search->bound * c.search->bound_unit.si; });
  for (Finding& f : findings) judge(f, value * f.expectation.unit.si);
  if (std::isnan(value) && failure.empty()) {
    const double low = quantity_at(c.search->from), high = failure.empty() ? quantity_at(last_value(*c.search)) : low;
    if (failure.empty()) fail(findings, why_none_is_good(*c.search, low, high));
  }
  if (!failure.empty()) fail(findings, failure);
  return findings;
}

}  // namespace

double smallest_good(const Search& search, const std::function<bool(double)>& good) {
  const auto at = [&](long n) { return search.from + static_cast<double>(n) * search.step; };
  long good_at = steps_of(search), bad_at = -1;
  if (!good(at(good_at))) return std::numeric_limits<double>::quiet_NaN();
  while (good_at - bad_at > 1) {
    const long middle = bad_at + (good_at - bad_at) / 2;
    (good(at(middle)) ? good_at : bad_at) = middle;
  }
  return at(good_at);
}

std::string why_none_is_good(const Search& search, double low, double high) {
  const auto seen = [&](double si, double at) {
    const std::string value = std::isnan(si) ? "null" : with_unit(si / search.bound_unit.si, search.bound_unit);
    return fmt::format("{} at {}", value, value_text(search, at));
  };
  const bool rises = low <= search.bound * search.bound_unit.si;
  return fmt::format("{} is {} and {} of {}: {} its bound of {}{}", search.quantity, seen(low, search.from),
                     seen(high, last_value(search)), search.key, rises ? "only the upper end misses" : "both ends miss",
                     with_unit(search.bound, search.bound_unit),
                     rises ? ", but a search needs a quantity that falls as the key rises" : "; search elsewhere");
}

std::vector<Finding> check_experiments(const std::vector<Expected>& experiments, RunPool& pool, const std::string& materials,
                                       const CheckSettings& settings) {
  std::vector<Task> tasks;
  for (const Expected& e : experiments)
    for (const CheckCase& c : e.cases) tasks.push_back({&e, &c});
  for (const Task& task : tasks)
    if (!task.one->skipped) read_scenes(*task.one, materials);

  std::vector<std::vector<Finding>> results(tasks.size());
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    for (std::size_t k = next++; k < tasks.size(); k = next++) {
      try {
        results[k] = judged(tasks[k], pool);
        const std::lock_guard lock(mutex);
        settings.on_case(results[k]);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        next = tasks.size();
      }
    }
  };
  std::vector<std::jthread> workers;
  for (int k = 1; k < settings.jobs; ++k) workers.emplace_back(work);
  work();
  workers.clear();  // joins
  if (error) std::rethrow_exception(error);

  std::vector<Finding> all;
  for (std::vector<Finding>& part : results) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace couloir
