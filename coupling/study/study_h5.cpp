#include <fmt/format.h>

#include <cstdio>

#include "coupling/records/h5.hpp"
#include "coupling/records/provenance.hpp"
#include "coupling/study/ladder.hpp"
#include "coupling/study/study_table.hpp"

namespace couloir {
namespace {

void write(const std::string& path, const Study& study, const std::string& status, const std::vector<StudyResult>& results) {
  const std::vector<StudyTableColumn> columns = study_table(study, results);
  const h5::Handle file = h5::create_file(path);
  std::string names;
  for (const StudyTableColumn& c : columns) names += (names.empty() ? "" : "\n") + c.name;
  h5::put_attributes(file, provenance_attributes("couloir study"));
  h5::put_attributes(
      file, {{"name", study.name}, {"title", study.title}, {"study", study.text}, {"status", status}, {"columns", names}});
  h5::put_attribute(file, "format_version", std::int64_t{1});
  h5::put_attribute(file, "total_cpu", total_cpu(results));  // [s]
  const h5::Handle rows = h5::create_group(file, "rows");
  for (const StudyTableColumn& c : columns) {
    const h5::Meaning meaning{c.text ? "" : c.unit, c.description};
    if (c.text) {
      h5::TextSeries series(rows, c.name, meaning);
      for (const std::string& text : c.texts) series.add(text);
      series.write();
    } else {
      h5::put(rows, c.name, c.numbers, {c.numbers.size()}, meaning);
    }
    const h5::Handle set(H5Dopen2(rows, c.name.c_str(), H5P_DEFAULT), path + " could not be written");
    h5::put_attribute(set, "role", c.role);
    h5::put_attribute(set, "label", c.label);
  }
  if (study.ladder) {
    h5::TextSeries ladder(file, "ladder", {"", "ladder.json: what each rung is off by and costs, and which to take"});
    ladder.add(ladder_json(study, results).dump());
    ladder.write();
  }
  h5::flush(file, path);
}

}  // namespace

void write_study_h5(const std::string& path, const Study& study, const std::string& status,
                    const std::vector<StudyResult>& results) {
  const std::string beside = path + ".tmp";
  try {
    write(beside, study, status, results);
  } catch (...) {
    std::remove(beside.c_str());
    throw;
  }
  if (std::rename(beside.c_str(), path.c_str()) != 0) throw RecordError(fmt::format("{} cannot be renamed to {}", beside, path));
}

}  // namespace couloir
