#include "coupling/records/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "coupling/records/provenance.hpp"
#include "coupling/records/text_file.hpp"
#include "coupling/scene/depths.hpp"

namespace couloir {
namespace {

using Json = nlohmann::ordered_json;

double rate(double count, double seconds, double wall) {
  const double over = seconds > 0 ? seconds : wall;
  return over > 0 ? count / over : 0;
}

Json time_json(const RunEnd& end, double simulated) {
  Json time{{"simulated", simulated}, {"wall", end.wall}, {"cpu", end.cpu}};
  const std::pair<const char*, double> shares[] = {
      {"continuum", end.cpu_continuum}, {"engine", end.cpu_engine}, {"coupling", end.cpu_coupling}};
  for (const auto& [name, cpu] : shares) time[std::string("cpu_") + name] = cpu;
  for (const auto& [name, cpu] : shares) time[std::string("share_") + name] = end.cpu > 0 ? cpu / end.cpu : 0;
  return time;
}

Json stress_json(double area, const ForceSeries& normal, const ForceSeries& up, const ForceSeries& across) {
  const double contact = normal.figures().first_contact;
  Json out{{"area", area}, {"first_contact", contact >= 0 ? Json(contact) : Json()}};
  const std::pair<const char*, const ForceSeries*> stresses[] = {
      {"normal", &normal}, {"shear_up", &up}, {"shear_across", &across}};
  for (const auto& [name, series] : stresses) {
    const ForceFigures f = series->figures();
    const std::string of = name;
    out[of + "_peak"] = f.peak;
    out[of + "_peak_time"] = f.peak_time;
    out[of + "_mean"] = f.mean;
    out[of + "_final"] = f.final;
    out[of + "_impulse"] = f.impulse;
  }
  return out;
}

Json together_json(const ForceSeries& own, const ForceSeries& by_control_volume, const ForceSeries& difference) {
  const auto json = [](const ForceFigures& f) {
    return Json{{"force_peak", f.peak}, {"force_peak_time", f.peak_time}, {"force_mean", f.mean_of_run}, {"impulse", f.impulse}};
  };
  const ForceFigures a = own.figures(), b = by_control_volume.figures(), d = difference.figures();
  const Json relative = a.peak != 0 ? Json(std::abs(d.peak / a.peak)) : Json();
  return {{"own", json(a)},
          {"control_volume", json(b)},
          {"difference", {{"largest", d.peak}, {"largest_time", d.peak_time}, {"mean", d.mean_of_run}, {"relative", relative}}}};
}

// Without a figure its keys are there all the same.
Json noise_json(const std::optional<CouplingNoise>& noise) {
  Json harmonics = Json::array();
  for (const NoiseHarmonic& h : noise ? noise->harmonics : std::vector<NoiseHarmonic>())
    harmonics.push_back(
        {{"frequency", h.frequency}, {"peak_over_neighbours", h.over_neighbours}, {"between_harmonics", h.between}});
  const auto figure = [&](auto CouplingNoise::*member) { return noise ? Json(*noise.*member) : Json(); };
  return {{"peak_over_neighbours", figure(&CouplingNoise::over_neighbours)},
          {"between_harmonics", figure(&CouplingNoise::between)},
          {"rms", figure(&CouplingNoise::rms)},
          {"resolution", figure(&CouplingNoise::resolution)},
          {"segments", figure(&CouplingNoise::segments)},
          {"harmonics", harmonics}};
}

Json coupling_noise_json(const std::vector<std::string>& names, const std::vector<std::optional<CouplingNoise>>& noises,
                         double window_frequency, double sampling_frequency) {
  Json all = Json::object(), largest;
  for (std::size_t k = 0; k < names.size(); ++k) {
    all[names[k]] = noise_json(noises[k]);
    if (noises[k] && (largest.is_null() || noises[k]->over_neighbours > largest.get<double>()))
      largest = noises[k]->over_neighbours;
  }
  return {{"window_frequency", window_frequency},
          {"sampling_frequency", sampling_frequency},
          {"peak_over_neighbours", largest},
          {"obstacles", all}};
}

// Out of the domain through this side.
double outward(const std::string& side, const std::array<double, 2>& f) {
  if (side == "upstream") return -f[0];
  if (side == "downstream") return f[0];
  return side == "left" ? -f[1] : f[1];
}

}  // namespace

Summary::Summary(const std::string& path) : path_(path), min_depth_(std::numeric_limits<double>::infinity()) {}

void Summary::on_start(const RunStart& start) {
  const Scene& scene = *start.scene;
  title_ = scene.title;
  scene_ = scene.file;
  mode_ = to_string(scene.mode);
  if (scene.mode != Mode::continuum) engine_ = scene.grains.engine;
  bulk_density_ = start.bulk_density;
  has_continuum_ = start.grid.nx > 0;
  cells_ = long(start.grid.nx) * start.grid.ny;
  effects_ = start.effects;
  obstacles_.clear(), gauges_.clear(), measures_.clear();
  for (const std::string& name : start.obstacles) obstacles_.emplace_back().name = name;
  if (has_continuum_)
    for (const GaugeSpec& gauge : scene.record.gauges) gauges_.push_back({gauge.name, GaugeSeries(arrival_depth(scene))});
  for (const ForceMeasure& m : start.measures) measures_.push_back({m, {}, 0});
  for (const StressGauge& g : start.stress_gauges) stresses_.push_back({g, {}, {}, {}});
  for (const StressGaugeSpec& g : scene.stress_gauges) {
    const std::string& of = scene.obstacles[std::size_t(g.obstacle)].name;
    const auto same = [&](const StressGauge& read) { return read.of == of && read.name == g.name; };
    if (std::ranges::none_of(start.stress_gauges, same)) unread_.emplace_back(of, g.name);
  }
  planes_ = start.planes_obstacle;
  window_ = start.window;
  sample_interval_ = start.sample_interval;
}

// In the order of the members; obstacles, gauges, measures and stresses are those of the scene.
void Summary::state(Archive& a) {
  const auto each = [&a](auto& all) {
    for (auto& one : all) a(one);
  };
  a(title_, scene_);
  each(obstacles_), each(gauges_), each(measures_), each(stresses_);
  a(together_, by_control_volume_, difference_);
  a(overflow_, max_heap_, max_climbed_, events_, resumptions_, last_, mass_error_, residual_, min_depth_, max_overlap_,
    max_speed_, peak_grains_);
}

void Summary::on_window(const WindowReport& window) {
  last_ = window;
  mass_error_ = std::max(mass_error_, window.mass.relative_error());
  take(window);
}

void Summary::take(const WindowReport& window) {
  if (window.momentum.scale > 0) residual_ = std::max(residual_, std::abs(window.momentum.residual) / window.momentum.scale);
  min_depth_ = std::min(min_depth_, window.min_depth);
  max_overlap_ = std::max(max_overlap_, window.max_overlap);
  max_speed_ = std::max(max_speed_, window.max_speed);
  peak_grains_ = std::max(peak_grains_, window.grains);
  for (std::size_t k = 0; k < obstacles_.size() && k < window.obstacles.size(); ++k) {
    const Vec& f = window.obstacles[k].force;
    obstacles_[k].along.add(window.time, window.length, f[0], f[0] != 0 || f[1] != 0 || f[2] != 0);
    obstacles_[k].impulse_across += f[1] * window.length;
    obstacles_[k].max_depth = std::max(obstacles_[k].max_depth, window.obstacles[k].depth_on_top);
    obstacles_[k].depth_final = window.obstacles[k].depth_on_top;
  }
  if (planes_ >= 0) {
    const ObstacleForce& o = window.obstacles[planes_];
    overflow_ = o.overflow;
    max_heap_ = std::max(max_heap_, o.heap);
    max_climbed_ = std::max(max_climbed_, o.climbed);
  }
  for (std::size_t k = 0; k < gauges_.size() && k < window.gauges.size(); ++k)
    gauges_[k].series.add(window.time, window.length, window.gauges[k]);
  const double own = window.force_together(), by_control_volume = window.force_by_control_volume();
  together_.add(window.time, window.length, own, own != 0);
  by_control_volume_.add(window.time, window.length, by_control_volume, true);
  difference_.add(window.time, window.length, by_control_volume - own, true);
  take_samples(window);
  take_measures(window);
  take_stresses(window);
}

void Summary::take_samples(const WindowReport& window) {
  for (std::size_t k = 0; sample_interval_ > 0 && k < obstacles_.size(); ++k) {
    Obstacle& o = obstacles_[k];
    o.met = o.met || (k < window.force_samples.size() && !window.force_samples[k].empty());
    const std::vector<double> samples = window.samples_of(k, sample_interval_);
    o.samples.insert(o.samples.end(), samples.begin(), samples.end());
  }
}

std::vector<std::optional<CouplingNoise>> Summary::noises() const {
  std::vector<std::optional<CouplingNoise>> out;
  for (const Obstacle& o : obstacles_) {
    out.emplace_back();
    const double contact = o.along.figures().first_contact;
    const auto first = std::size_t(std::ceil(std::max(0.0, contact) / sample_interval_ - 1e-6));
    if (!o.met || contact < 0 || first >= o.samples.size()) continue;
    const std::vector<double> since(o.samples.begin() + std::ptrdiff_t(first), o.samples.end());
    out.back() = coupling_noise(since, int(std::lround(window_ / sample_interval_)), sample_interval_);
  }
  return out;
}

void Summary::take_stresses(const WindowReport& window) {
  for (std::size_t k = 0; k < stresses_.size() && k < window.stresses.size(); ++k) {
    const GaugeStress& s = window.stresses[k];
    const bool contact = s.normal != 0 || s.up != 0 || s.across != 0;
    stresses_[k].normal.add(window.time, window.length, s.normal, contact);
    stresses_[k].up.add(window.time, window.length, s.up, contact);
    stresses_[k].across.add(window.time, window.length, s.across, contact);
  }
}

void Summary::take_measures(const WindowReport& window) {
  for (std::size_t k = 0; k < measures_.size() && k < window.measures.size(); ++k) {
    Measure& m = measures_[k];
    const auto& f = window.measures[k];
    m.series.add(window.time, window.length, m.what.kind == "wall" ? outward(m.what.of, f) : f[0], true);
    m.impulse_across += f[1] * window.length;
  }
}

void Summary::on_event(const Event& event) {
  events_.push_back(event);
}

void Summary::on_finish(const RunEnd& end) {
  text_ = made(end);
  write_atomically(path_, text_);
}

std::string Summary::made(const RunEnd& end) const {
  const MassLedger& m = last_.mass;
  Json out;
  out["status"] = end.status;
  out["reason"] = end.reason;
  out["title"] = title_;
  out["scene"] = scene_;
  out["mode"] = mode_;
  out["revision"] = provenance().revision;
  out["instruction_set"] = provenance().instruction_set;
  out["engine"] = end.engine.empty() ? engine_ : end.engine;
  out["bulk_density"] = bulk_density_;
  out["time"] = time_json(end, last_.time);
  out["mass"] = {{"initial", m.initial},           {"final", m.continuum + m.grains + m.faces + m.airborne},
                 {"left_domain", m.left_domain},   {"entered", m.entered},
                 {"overtopped", last_.overtopped}, {"relative_error", mass_error_}};
  out["momentum"] = {{"relative_residual", residual_}};
  std::int64_t cells = last_.levels.empty() ? cells_ : 0;
  Json levels = Json::array();
  for (const LevelCells& l : last_.levels) {
    cells += l.cells;
    levels.push_back({{"level", l.level}, {"cell", l.cell}, {"blocks", l.blocks}, {"cells", l.cells}});
  }
  out["continuum"] = {{"cells", cells},
                      {"levels", levels},
                      {"steps", last_.solver_steps},
                      {"cell_updates", last_.cell_updates},
                      {"cell_updates_per_second", rate(double(last_.cell_updates), end.cpu_continuum, end.wall)},
                      {"min_depth", has_continuum_ && std::isfinite(min_depth_) ? Json(min_depth_) : Json()},
                      {"refinement_drift", last_.mass.copied}};
  out["grains"] = {{"inserted", last_.inserted},
                   {"returned", last_.returned},
                   {"peak_count", std::max(peak_grains_, end.peak_grains)},
                   {"steps", last_.engine_steps},
                   {"particle_steps", end.particle_steps},
                   {"particle_steps_per_second", rate(double(end.particle_steps), end.cpu_engine, end.wall)},
                   {"max_overlap", max_overlap_}};
  out["flow"] = {{"max_speed", max_speed_}};
  out["obstacles"] = Json::object();
  for (const Obstacle& o : obstacles_) {
    const ForceFigures f = o.along.figures();
    out["obstacles"][o.name] = {{"force_peak", f.peak},
                                {"force_peak_time", f.peak_time},
                                {"force_peak_window", f.peak_window},
                                {"force_mean", f.mean},
                                {"force_final", f.final},
                                {"first_contact", f.first_contact >= 0 ? Json(f.first_contact) : Json()},
                                {"impulse", f.impulse},
                                {"impulse_across", o.impulse_across},
                                {"max_depth_on_top", o.max_depth},
                                {"depth_on_top_final", o.depth_final}};
  }
  if (planes_ >= 0) {
    out["obstacles"][obstacles_[planes_].name].update(
        {{"overflow", overflow_}, {"max_heap", max_heap_}, {"max_climbed", max_climbed_}});
  }
  for (const Stresses& s : stresses_)
    out["obstacles"][s.what.of]["gauges"][s.what.name] = stress_json(s.what.area, s.normal, s.up, s.across);
  for (const auto& [of, name] : unread_) {
    Json& gauge = out["obstacles"][of]["gauges"][name] = stress_json(0, {}, {}, {});
    for (auto& figure : gauge) figure = Json();
  }
  if (!obstacles_.empty()) out["obstacles_together"] = together_json(together_, by_control_volume_, difference_);
  if (!obstacles_.empty() && sample_interval_ > 0) {
    std::vector<std::string> names;
    for (const Obstacle& o : obstacles_) names.push_back(o.name);
    out["coupling_noise"] = coupling_noise_json(names, noises(), 1 / window_, 1 / sample_interval_);
  }
  out["gauges"] = Json::object();
  for (const Gauge& gauge : gauges_) {
    const GaugeSeries& g = gauge.series;
    out["gauges"][gauge.name] = {{"max_depth", g.max_depth},
                                 {"max_depth_time", g.max_depth_time},
                                 {"depth_final", g.depth_final},
                                 {"depth_mean", g.depth_mean()},
                                 {"velocity_mean", g.velocity_mean()},
                                 {"max_speed", g.max_speed},
                                 {"arrival", g.arrival >= 0 ? Json(g.arrival) : Json()}};
  }
  out["walls"] = Json::object();
  for (const Measure& m : measures_) {
    const ForceFigures f = m.series.figures();
    Json figures{{"maximum", f.peak_window}, {"peak", f.peak},   {"peak_time", f.peak_time},
                 {"mean", f.mean_of_run},    {"final", f.final}, {"impulse", f.impulse}};
    if (m.what.kind == "wall") {
      out["walls"][m.what.of] = figures;
    } else {
      figures["impulse_across"] = m.impulse_across;
      out["obstacles"][m.what.of][m.what.kind] = figures;
    }
  }
  out["costs"] = Json::array();
  for (const PartCost& c : end.costs) {
    out["costs"].push_back({{"part", c.part},
                            {"effect", c.effect.empty() ? Json() : Json(c.effect)},
                            {"seconds", c.seconds},
                            {"share", end.cpu > 0 ? c.seconds / end.cpu : 0}});
  }
  out["effects"] = Json::array();
  for (const Effect& e : effects_) out["effects"].push_back({{"name", e.name}, {"on", e.on}, {"reason", e.reason}});
  out["events"] = Json::array();
  for (const Event& e : events_) out["events"].push_back({{"time", e.time}, {"what", e.what}});
  out["resumed"] = Json::array();
  for (const Resumption& r : resumptions_) out["resumed"].push_back({{"time", r.time}, {"reason", r.reason}});
  // A name or an engine's message that is not UTF-8 must not cost the run its summary.
  return out.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace couloir
