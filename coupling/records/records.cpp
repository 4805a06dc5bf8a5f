#include "coupling/records/records.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <ctime>
#include <filesystem>

#include "coupling/checkpoint/checkpoint_folder.hpp"
#include "coupling/checkpoint/safe_file.hpp"
#include "coupling/records/columns.hpp"
#include "coupling/records/level_frame.hpp"
#include "coupling/records/provenance.hpp"
#include "coupling/scene/depths.hpp"

namespace couloir {
namespace {

constexpr long kWaitingWindows = 256;
constexpr int kSurfacePoints = 401;

std::string now_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace

Records::Records(const std::string& path, const std::string& scene_text, const std::string& checkpoints, bool resumed,
                 Started started)
    : path_(path), scene_text_(scene_text), checkpoints_(checkpoints), started_(std::move(started)) {
  if (!resumed) file_ = h5::create_file(path, journal_);
}

Records::~Records() = default;

// HDF5 cannot take back a write that failed half-way. The first failure is thrown; after it the file is left alone, as it was at
// the last flush.
void Records::guarded(const std::function<void()>& write) {
  if (failed_) return;
  try {
    write();
  } catch (const RecordError& error) {
    failed_ = true;
    throw RecordError(std::string(error.what()) + "; free space there or choose another --out");
  }
}

void Records::on_start(const RunStart& start) {
  start_ = start;
  surface_ = start.surface;
  grid_ = start.grid;
  bed_ = start.bed;
  thin_ = thin_depth(*start.scene);
  if (start.resumed) return;
  guarded([&] {
    write_root(*start.scene, start.bulk_density);
    write_surface();
    write_grid(start);
    open_series();
    h5::flush(file_, path_);
  });
}

void Records::state(Archive& a) {
  if (!a.loading()) {
    guarded([&] {
      write_waiting();
      h5::flush(file_, path_);
    });
    sync_file(path_);
    settled_ = std::filesystem::file_size(path_);
  }
  a(settled_);
  if (!a.loading()) return;
  close();
  const std::string journal = CheckpointFolder::journal(checkpoints_, a.number());
  UndoJournal::roll_back(path_, journal, settled_);
  journal_.begin(journal, settled_);
  file_ = h5::open_file(path_, journal_);
  open_series();
}

void Records::on_checkpoint(std::int64_t number) {
  journal_.begin(CheckpointFolder::journal(checkpoints_, number), settled_);
}

void Records::on_resume(const Resumption& r) {
  guarded([&] {
    const std::string before = h5::has_attribute(file_, "resumed") ? h5::text_attribute(file_, "resumed") + "\n" : "";
    h5::put_attribute(file_, "resumed", fmt::format("{}at {:.9g} s: {}", before, r.time, r.reason));
    h5::flush(file_, path_);
  });
}

// The last to go is the file: HDF5 closes it when nothing in it is open.
void Records::close() {
  columns_.clear(), forces_.clear(), samples_.clear(), planes_.reset(), gauges_.clear(), measures_.clear(), stresses_.clear();
  event_time_.reset(), event_text_.reset();
  waiting_ = 0;
  frames_.reset();
  file_.reset();
}

void Records::write_root(const Scene& scene, double bulk_density) {
  h5::put_attributes(file_, provenance_attributes("couloir records"));
  h5::put_attributes(file_, {{"start_time", now_utc()},
                             {"title", scene.title},
                             {"mode", to_string(scene.mode)},
                             {"scene", scene_text_},
                             {"scene_as_given", scene.text},
                             {"engine", scene.mode == Mode::continuum ? "" : scene.grains.engine},
                             {"build", started_.build},
                             {"status", "running"}});
  h5::put_attribute(file_, "threads", std::int64_t{started_.threads});
  h5::put_attribute(file_, "ranks", std::int64_t{started_.ranks});
  h5::put_attribute(file_, "format_version", std::int64_t{kFormatVersion});
  h5::put_attribute(file_, "seed", std::int64_t{scene.grains.seed});
  h5::put_attribute(file_, "bulk_density", bulk_density);             // [kg/m3]
  h5::put_attribute(file_, "gravity", scene.gravity);                 // [m/s2]
  h5::put_attribute(file_, "grain_diameter", scene.grains.diameter);  // [m]
  h5::put_attribute(file_, "width", scene.terrain.width);             // [m]
  h5::put_attribute(file_, "duration", scene.duration);               // [s]
}

void Records::write_surface() {
  const h5::Handle group = h5::create_group(file_, "surface");
  std::vector<double> x, angle, line;
  for (int k = 0; k < kSurfacePoints; ++k) {
    x.push_back(surface_->length() * k / (kSurfacePoints - 1));
    angle.push_back(surface_->angle(x.back()));
    const Eigen::Vector3d p = surface_->to_level(surface_->to_space({x.back(), 0, 0}));
    line.insert(line.end(), p.data(), p.data() + 3);
  }
  const hsize_t n = kSurfacePoints;
  h5::put(group, "x", x, {n}, {"m", "arc length along the reference surface from its upper edge"});
  h5::put(group, "angle", angle, {n}, {"rad", "inclination against the horizontal"});
  h5::put(group, "line", line, {n, 3}, {"m", "centre line of the reference surface in the level frame"});
}

void Records::write_grid(const RunStart& start) {
  const h5::Handle obstacles = h5::create_group(file_, "obstacles");
  for (const ObstacleSpec& o : start.scene->obstacles) {
    const h5::Handle group = h5::create_group(obstacles, o.name);
    h5::put_attribute(group, "unit", "m");
    h5::put_attribute(group, "description", "x, y: middle of the upstream edge of the footprint; length along the slope");
    const std::pair<const char*, double> numbers[] = {
        {"x", o.x}, {"y", o.y}, {"length", o.length}, {"width", o.width}, {"height", o.height}};
    for (const auto& [name, value] : numbers) h5::put_attribute(group, name, value);
    if (o.shape != ObstacleSpec::Shape::mesh) continue;
    std::vector<double> corners;
    for (const BodyTriangle& t : o.body->triangles())
      for (const BodyPoint& p : t) corners.insert(corners.end(), {o.x + p[0], o.y + p[1], p[2]});
    h5::put(
        group, "triangles", corners, {o.body->triangles().size(), 3, 3},
        {"m", "corners [x, y, height above the bed] of the body's triangles, counter-clockwise from outside, without its base"});
  }
  const h5::Handle effects = h5::create_group(file_, "effects");
  h5::TextSeries name(effects, "name", {"", "physical or numerical effect"}),
      reason(effects, "reason", {"", "why it is on or off"});
  h5::Series on(effects, "on", {"1", "1: simulated, 0: not"});
  for (const Effect& e : start.effects) name.add(e.name), on.add(e.on), reason.add(e.reason);
  name.write(), on.write(), reason.write();

  const h5::Handle group = h5::create_group(file_, "grid");
  if (grid_.nx == 0) return;
  std::vector<double> x, y;
  for (int i = 0; i < grid_.nx; ++i) x.push_back(grid_.x(i));
  for (int j = 0; j < grid_.ny; ++j) y.push_back(grid_.y(j));
  const hsize_t nx = grid_.nx, ny = grid_.ny;
  const std::vector<double> bed = bed_.empty() ? std::vector<double>(nx * ny, 0.0) : bed_;
  h5::put(group, "x", x, {nx}, {"m", "cell centres, arc length along the slope"});
  h5::put(group, "y", y, {ny}, {"m", "cell centres, across the slope"});
  h5::put(group, "bed", bed, {ny, nx}, {"m", "elevation and step obstacles above the reference surface, along its normal"});
  h5::put(group, "nodes", level_nodes(grid_, *surface_), {ny + 1, nx + 1, 3},
          {"m", "cell corners on the reference surface in the level frame"});
}

void Records::open_series() {
  const RunStart& start = start_;
  frames_ = h5::create_group(file_, "frames");
  const h5::Handle windows = h5::create_group(file_, "windows");
  for (const WindowColumn& c : window_columns()) columns_.emplace_back(windows, c.name, h5::Meaning{c.unit, c.description});
  const h5::Handle forces = h5::create_group(file_, "forces");
  for (const std::string& name : start.obstacles) {
    const h5::Handle group = h5::create_group(forces, name);
    forces_.push_back({h5::Series(group, "time", {"s", "end of the window"}),
                       h5::Series(group, "fx", {"N", "force along the slope, mean over the window"}),
                       h5::Series(group, "fy", {"N", "force across the slope, mean over the window"}),
                       h5::Series(group, "fz", {"N", "force along the normal, mean over the window"}),
                       h5::Series(group, "depth_on_top", {"m", "largest depth on the obstacle's top at the window's end"})});
  }
  if (start.sample_interval > 0) {
    const h5::Handle samples = h5::create_group(file_, "force_samples");
    for (const std::string& name : start.obstacles) {
      const h5::Handle group = h5::create_group(samples, name);
      h5::put_attribute(group, "interval", start.sample_interval);  // [s]
      h5::put_attribute(group, "window", start.window);             // [s]
      samples_.emplace_back(group, "fx", h5::Meaning{"N", "force along the slope, mean over each interval from the start on"});
    }
  }
  planes_obstacle_ = start.planes_obstacle;
  if (planes_obstacle_ >= 0) {
    const h5::Handle group = h5::create_group(h5::create_group(file_, "planes"), start.obstacles[planes_obstacle_]);
    planes_ = {h5::Series(group, "overflow", {"kg", "mass that came over the upper edges since the start"}),
               h5::Series(group, "heap", {"m", "greatest depth on the slope along the foot of the front, at the window's end"}),
               h5::Series(group, "climbed", {"m", "how high the front is covered, at the window's end"})};
  }
  const h5::Handle gauges = h5::create_group(file_, "gauges");
  for (const GaugeSpec& gauge : start.scene->record.gauges) {
    const h5::Handle group = h5::create_group(gauges, gauge.name);
    gauges_.push_back({h5::Series(group, "time", {"s", "end of the window"}),
                       h5::Series(group, "depth", {"m", "depth of the flow at the gauge, at the window's end"}),
                       h5::Series(group, "velocity_along", {"m/s", "along the slope"}),
                       h5::Series(group, "velocity_across", {"m/s", "across the slope"})});
  }
  const h5::Handle measures = h5::create_group(file_, "measures");
  for (const ForceMeasure& m : start.measures) {
    const h5::Handle group = h5::create_group(h5::create_group(measures, m.kind), m.of);
    measures_.push_back({h5::Series(group, "fx", {"N", "force along the slope by this measure, mean over the window"}),
                         h5::Series(group, "fy", {"N", "force across the slope by this measure, mean over the window"})});
  }
  const h5::Handle stresses = h5::create_group(file_, "stresses");
  for (const StressGauge& g : start.stress_gauges) {
    const h5::Handle group = h5::create_group(h5::create_group(stresses, g.of), g.name);
    h5::put_attribute(group, "area", g.area);  // [m2]
    stresses_.push_back({h5::Series(group, "normal", {"Pa", "by the grains into the face, mean over the window"}),
                         h5::Series(group, "up", {"Pa", "shear along the face's height, mean over the window"}),
                         h5::Series(group, "across", {"Pa", "shear across the slope, mean over the window"})});
  }
  const h5::Handle events = h5::create_group(file_, "events");
  event_time_.emplace(events, "time", h5::Meaning{"s", "when"});
  event_text_.emplace(events, "text", h5::Meaning{"", "what happened, and why"});
}

void Records::on_window(const WindowReport& window) {
  const std::vector<WindowColumn>& table = window_columns();
  for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].add(table[k].value(window));
  for (std::size_t k = 0; k < forces_.size() && k < window.obstacles.size(); ++k) {
    const ObstacleForce& o = window.obstacles[k];
    forces_[k].time.add(window.time);
    forces_[k].fx.add(o.force[0]);
    forces_[k].fy.add(o.force[1]);
    forces_[k].fz.add(o.force[2]);
    forces_[k].depth_on_top.add(o.depth_on_top);
  }
  for (std::size_t k = 0; k < samples_.size(); ++k)
    for (const double f : window.samples_of(k, start_.sample_interval)) samples_[k].add(f);
  for (std::size_t k = 0; k < gauges_.size() && k < window.gauges.size(); ++k) {
    const GaugeReading& g = window.gauges[k];
    gauges_[k].time.add(window.time);
    gauges_[k].depth.add(g.depth);
    gauges_[k].along.add(g.velocity_along);
    gauges_[k].across.add(g.velocity_across);
  }
  for (std::size_t k = 0; k < measures_.size() && k < window.measures.size(); ++k) {
    measures_[k].fx.add(window.measures[k][0]);
    measures_[k].fy.add(window.measures[k][1]);
  }
  for (std::size_t k = 0; k < stresses_.size() && k < window.stresses.size(); ++k) {
    stresses_[k].normal.add(window.stresses[k].normal);
    stresses_[k].up.add(window.stresses[k].up);
    stresses_[k].across.add(window.stresses[k].across);
  }
  if (planes_) {
    const ObstacleForce& o = window.obstacles[planes_obstacle_];
    planes_->overflow.add(o.overflow);
    planes_->heap.add(o.heap);
    planes_->climbed.add(o.climbed);
  }
  if (++waiting_ < kWaitingWindows) return;
  guarded([&] {
    write_waiting();
    h5::flush(file_, path_);
  });
}

void Records::write_waiting() {
  for (h5::Series& column : columns_) column.write();
  for (ForceColumns& f : forces_)
    for (h5::Series* series : {&f.time, &f.fx, &f.fy, &f.fz, &f.depth_on_top}) series->write();
  for (h5::Series& samples : samples_) samples.write();
  for (GaugeColumns& g : gauges_)
    for (h5::Series* series : {&g.time, &g.depth, &g.along, &g.across}) series->write();
  for (MeasureColumns& m : measures_) m.fx.write(), m.fy.write();
  for (StressColumns& s : stresses_) s.normal.write(), s.up.write(), s.across.write();
  if (planes_)
    for (h5::Series* series : {&planes_->overflow, &planes_->heap, &planes_->climbed}) series->write();
  event_time_->write();
  event_text_->write();
  waiting_ = 0;
}

void Records::on_frame(const FrameView& view) {
  guarded([&] {
    write_waiting();
    const h5::Handle frame = h5::create_group(frames_, fmt::format("{:06d}", view.index));
    h5::put(frame, "time", std::vector<double>{view.time}, {}, {"s", "simulated time"});
    if (view.h) write_flow(frame, view);
    if (view.blocks) write_blocks(frame, *view.blocks);
    if (view.planes) write_planes(frame, *view.planes);
    if (view.grains) write_grains(frame, *view.grains);
    h5::flush(file_, path_);
  });
}

void Records::write_flow(hid_t frame, const FrameView& view) {
  const hsize_t nx = grid_.nx, ny = grid_.ny;
  h5::put(frame, "h", *view.h, {ny, nx},
          {"m", "depth along the normal; coarse-grained from the grains in the zone; refined cells: their mean"});
  h5::put(frame, "hu", *view.hu, {ny, nx}, {"m2/s", "depth times velocity along the slope"});
  h5::put(frame, "hv", *view.hv, {ny, nx}, {"m2/s", "depth times velocity across the slope"});
  h5::put(frame, "surface", level_free_surface(grid_, *surface_, bed_, *view.h), {ny, nx, 3},
          {"m", "free surface above the cell centres in the level frame"});
  h5::put(frame, "velocity", level_velocity(grid_, *surface_, *view.h, *view.hu, *view.hv, thin_), {ny, nx, 3},
          {"m/s", "depth-averaged velocity in the level frame"});
  if (view.zones.empty()) return;
  std::vector<double> edges;
  for (const CellBox& z : view.zones)
    edges.insert(edges.end(), {grid_.x0 + z.i0 * grid_.dx, grid_.x0 + z.i1 * grid_.dx, grid_.y0 + z.j0 * grid_.dy,
                               grid_.y0 + z.j1 * grid_.dy});
  h5::put(frame, "zones", edges, {view.zones.size(), 4}, {"m", "rectangles that grains hold: x from, to; y from, to"});
}

void Records::write_blocks(hid_t frame, const BlocksView& blocks) {
  const h5::Handle group = h5::create_group(frame, "blocks");
  const auto column = [&](const char* name, int BlockPlace::*member, const std::string& what) {
    std::vector<std::int64_t> all;
    for (const BlockPlace& b : blocks.places) all.push_back(b.*member);
    h5::put(group, name, all, {all.size()}, {"1", what});
  };
  const std::string first = "the block's first cell, counted on the grid of its level";
  column("level", &BlockPlace::level, "how often the coarsest cells are halved in this block");
  column("i0", &BlockPlace::i0, "along the slope: " + first);
  column("j0", &BlockPlace::j0, "across the slope: " + first);
  column("nx", &BlockPlace::nx, "cells of the block along the slope");
  column("ny", &BlockPlace::ny, "cells of the block across the slope");
  const std::string order = "; block after block, each [ny, nx]; where blocks lie on one another the finest counts";
  const hsize_t n = blocks.h.size();
  h5::put(group, "h", blocks.h, {n}, {"m", "depth along the normal" + order});
  h5::put(group, "hu", blocks.hu, {n}, {"m2/s", "depth times velocity along the slope" + order});
  h5::put(group, "hv", blocks.hv, {n}, {"m2/s", "depth times velocity across the slope" + order});
}

void Records::write_planes(hid_t frame, const std::vector<PlaneView>& planes) {
  const h5::Handle group = h5::create_group(frame, "planes");
  for (const PlaneView& plane : planes) {
    const h5::Handle own = h5::create_group(group, plane.name);
    const hsize_t na = plane.grid.nx, nb = plane.grid.ny;
    std::vector<double> a, b;
    for (int i = 0; i < plane.grid.nx; ++i) a.push_back(plane.grid.x(i));
    for (int j = 0; j < plane.grid.ny; ++j) b.push_back(plane.grid.y(j));
    h5::put(own, "a", a, {na}, {"m", "cell centres along the plane's first axis: up (front, back), down the slope (others)"});
    h5::put(own, "b", b, {nb},
            {"m", "along its second axis: across from the obstacle's middle (front, back, top), up (left, right)"});
    h5::put(own, "h", plane.h, {nb, na}, {"m", "depth along the plane's own normal"});
    h5::put(own, "ha", plane.ha, {nb, na}, {"m2/s", "depth times velocity along the first axis"});
    h5::put(own, "hb", plane.hb, {nb, na}, {"m2/s", "depth times velocity along the second axis"});
  }
}

void Records::write_grains(hid_t frame, const Grains& grains) {
  const h5::Handle group = h5::create_group(frame, "grains");
  const hsize_t n = grains.size();
  h5::put(group, "id", grains.id, {n}, {"1", "number of the grain, unique over the run"});
  h5::put(group, "x", grains.x, {n}, {"m", "centre in the tilted frame, along the incline"});
  h5::put(group, "y", grains.y, {n}, {"m", "centre in the tilted frame, across the slope"});
  h5::put(group, "z", grains.z, {n}, {"m", "centre in the tilted frame, normal to the incline"});
  h5::put(group, "vx", grains.vx, {n}, {"m/s", "velocity in the tilted frame, along the incline"});
  h5::put(group, "vy", grains.vy, {n}, {"m/s", "velocity in the tilted frame, across the slope"});
  h5::put(group, "vz", grains.vz, {n}, {"m/s", "velocity in the tilted frame, normal to the incline"});
  h5::put(group, "radius", grains.radius, {n}, {"m", "radius"});
  h5::put(group, "driven", grains.driven, {n}, {"1", "1: in a driven layer"});
  h5::put(group, "position", level_positions(*surface_, grains), {n, 3}, {"m", "centre in the level frame"});
  h5::put(group, "velocity", level_velocities(*surface_, grains), {n, 3}, {"m/s", "velocity in the level frame"});
}

void Records::on_event(const Event& event) {
  if (!event_time_) return;
  event_time_->add(event.time);
  event_text_->add(event.what);
}

void Records::on_finish(const RunEnd& end) {
  if (file_.empty()) return;  // it could not even be opened again
  guarded([&] {
    if (event_time_) write_waiting();
    h5::put_attribute(file_, "status", end.status);
    h5::put_attribute(file_, "reason", end.reason);
    if (!end.engine.empty()) h5::put_attribute(file_, "engine", end.engine);
    h5::flush(file_, path_);
  });
}

}  // namespace couloir
