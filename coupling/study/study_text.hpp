#pragma once
// What a study tells the one who waits for it.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupling/study/study_run.hpp"

namespace couloir {

// "done    Table 5.5, 0.1 / 0.2 [seed]: critical = 4.4 (Table 5.5: 4.4); 7 runs"
std::string row_line(const StudyRow&, const StudyResult&);
// "3 of 10 rows, 2 min 10 s left"
std::string progress_line(const StudyProgress&);
// Row by row: name, quantities with mean and scatter where there are replicates, processor time; counts below.
std::string results_table(const Study&, const std::vector<StudyResult>&);

// "12 %"; "-" where there is none.
std::string percent(double share);
// Left-aligned columns.
std::string columns_text(const std::vector<std::vector<std::string>>& rows);

// What would run, and what it costs by the plan. `done`: whether the row's run is there already; a search's is not known.
struct DryRow {
  bool done = false;
};
std::string dry_run_table(const Study&, const std::vector<DryRow>&, int jobs);
nlohmann::ordered_json dry_run_json(const Study&, const std::vector<DryRow>&);

}  // namespace couloir
