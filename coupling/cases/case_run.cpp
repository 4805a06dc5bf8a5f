#include "coupling/cases/case_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/cases/summary_value.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {

std::vector<Scene> scenes_of(const CaseRun& c, const std::string& materials) {
  try {
    if (!c.search) return {read_scene(c.scene, materials, c.set)};
    std::vector<Scene> ends;
    for (const double end : {c.search->from, c.search->last()})
      ends.push_back(read_scene(c.scene, materials, with_value(c.set, *c.search, end)));
    return ends;
  } catch (const SceneError& error) {
    throw SceneError(fmt::format("{}: {}: {}", c.place, c.name, error.what()));
  }
}

CaseOutcome run_case(const CaseRun& c, RunPool& pool) {
  CaseOutcome out;
  const auto run = [&](const Overrides& set) {
    PooledRun one = pool.run(c.scene, set);
    if (std::ranges::none_of(out.runs, [&](const PooledRun& r) { return r.folder == one.folder; })) out.runs.push_back(one);
    return one;
  };
  if (!c.search) {
    out.run = run(c.set);
    out.failure = out.run.failure;
    return out;
  }
  std::string failed;
  const SearchResult found = search_critical(
      *c.search,
      [&](double at) {
        const PooledRun one = run(with_value(c.set, *c.search, at));
        failed = one.failure;
        return failed.empty() ? summary_value(one.summary, c.search->quantity, c.place)
                              : std::numeric_limits<double>::quiet_NaN();
      },
      [&] { return failed; });
  out.critical = found.critical;
  out.failure = found.failure;
  out.remark = found.remark;
  if (!std::isnan(out.critical)) out.run = run(with_value(c.set, *c.search, out.critical));
  return out;
}

}  // namespace couloir
