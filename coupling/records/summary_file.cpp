#include "coupling/records/summary_file.hpp"

#include <filesystem>
#include <fstream>

namespace couloir {

SummaryFile read_summary(const std::string& path) {
  SummaryFile out;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {  // a folder of that name would throw when read
    out.fault = "is missing";
    return out;
  }
  std::ifstream in(path, std::ios::binary);
  nlohmann::json read = nlohmann::json::parse(in, nullptr, false);  // damaged: a value of its own, no exception
  if (read.is_object())
    out.content = std::move(read);
  else
    out.fault = "cannot be read";
  return out;
}

}  // namespace couloir
