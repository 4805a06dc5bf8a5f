#include "coupling/cases/kept_run.hpp"

#include <filesystem>

#include "coupling/records/summary_file.hpp"

namespace couloir {

namespace fs = std::filesystem;

KeptRun kept_run(const std::string& folder) {
  KeptRun out;
  std::error_code ignored;
  out.is_there = fs::exists(fs::symlink_status(folder, ignored));
  if (!out.is_there) return out;
  SummaryFile file = read_summary((fs::path(folder) / "summary.json").string());
  if (!file.fault.empty())
    out.fault = "summary.json " + file.fault;
  else if (!file.content.contains("status") || file.content["status"] != "done")
    out.fault = "summary.json does not say that it is done";
  else if (!fs::exists(fs::path(folder) / "records.h5", ignored))
    out.fault = "records.h5 is missing";
  else
    out.summary = std::move(file.content);
  return out;
}

}  // namespace couloir
