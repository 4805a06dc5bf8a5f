#include "coupling/calibration/measurements.hpp"

#include <unistd.h>

#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "coupling/cases/share_out.hpp"
#include "coupling/engine/engine_error.hpp"
#include "coupling/engine/worker_engine.hpp"
#include "coupling/records/text_file.hpp"

namespace couloir {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string line_of(const std::string& made_by, const std::string& key, const SlabCurve& c) {
  Json points = Json::array();
  for (const SlabPoint& p : c.points) points.push_back({p.time, p.speed, p.friction, p.inertia, p.slip});
  return Json{{"made_by", made_by},
              {"measurement", key},
              {"engine", c.engine},
              {"grains", c.grains},
              {"solid_fraction", c.solid_fraction},
              {"points", points}}
      .dump();
}

// False: the line is damaged, or of another program.
bool read_line(const std::string& line, const std::string& made_by, std::string& key, SlabCurve& c) {
  try {
    const Json j = Json::parse(line);
    if (j.at("made_by") != made_by) return false;
    key = j.at("measurement");
    c.engine = j.at("engine");
    c.grains = j.at("grains");
    c.solid_fraction = j.at("solid_fraction");
    for (const Json& p : j.at("points")) c.points.push_back({p.at(0), p.at(1), p.at(2), p.at(3), p.at(4)});
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace

Measurements::Measurements(MeasurementSettings settings) : settings_(std::move(settings)) {
  std::string whole;
  if (fs::exists(settings_.file)) {
    std::istringstream lines(read_text(settings_.file));
    for (std::string line; std::getline(lines, line);) {
      std::string key;
      SlabCurve curve;
      if (!read_line(line, settings_.made_by, key, curve)) continue;
      kept_[key] = curve;
      whole += (whole.empty() ? "" : "\n") + line;
    }
  }
  // Without a line that a kill has cut.
  if (fs::exists(settings_.file)) write_atomically(settings_.file, whole);
}

std::string Measurements::key(const SlabSpec& spec) const {
  return settings_.engine + " " + describe(spec);
}

std::vector<SlabCurve> Measurements::measure(const std::vector<SlabSpec>& specs) {
  std::vector<const SlabSpec*> missing;
  std::set<std::string> asked;
  for (const SlabSpec& s : specs)
    if (!kept_.contains(key(s)) && asked.insert(key(s)).second) missing.push_back(&s);

  TextFile file(settings_.file, true);
  std::mutex mutex;
  const auto make = [&](std::size_t k) {
    const fs::path folder = fs::path(settings_.work_dir) / ("measurement-" + std::to_string(getpid()) + "-" + std::to_string(k));
    fs::create_directories(folder);
    WorkerEngine engine(settings_.worker);
    SlabCurve curve;
    try {
      curve = slide(*missing[k], engine, settings_.packings, folder.string(), settings_.stop);
    } catch (const EngineError&) {
      throw;  // its folder stays: it holds the engine's log
    } catch (...) {
      fs::remove_all(folder);
      throw;
    }
    fs::remove_all(folder);
    const std::lock_guard lock(mutex);
    file.line(line_of(settings_.made_by, key(*missing[k]), curve));
    kept_[key(*missing[k])] = std::move(curve);
    ++made_;
    if (settings_.on_measurement) settings_.on_measurement(made_);
  };
  share_out(missing.size(), settings_.jobs, make, settings_.stop);
  std::vector<SlabCurve> curves;
  for (const SlabSpec& s : specs) {
    const auto found = kept_.find(key(s));
    if (found == kept_.end()) throw Stopped();
    curves.push_back(found->second);
  }
  return curves;
}

}  // namespace couloir
