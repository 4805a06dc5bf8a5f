#include "demands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/plan/build.hpp"
#include "coupling/plan/stiffness.hpp"
#include "coupling/scene/inflow.hpp"
#include "coupling/scene/release_shape.hpp"

namespace couloir {
namespace {

constexpr double round_off = 1e-12;
constexpr double least_depth = 0.01;    // [d] thinner, a flow carries no grains worth sending (Zone::least_depth)
constexpr double most_residual = 0.05;  // what the two sides of a face do not give each other in a window
// Of u0^2 + 2 g (highest level of material - level here + d): a grain that a face sends in has the flow's speed, which is a mean
// over a cell, hence the d. Neighbours can pass a little on to a grain; nothing is shot away.
constexpr double most_energy = 1.05;
constexpr double most_overlap = 0.1;  // [d]

}  // namespace

void Demands::demand(bool holds, double time, const std::string& what) {
  if (!holds && broken_.size() < 10) broken_.push_back(fmt::format("t = {:.6g} s: {}", time, what));
}

void Demands::on_start(const RunStart& start) {
  scene_ = start.scene;
  surface_ = start.surface;
  grid_ = start.grid;
  bed_ = start.bed;
  const auto level = [&](double x, double n) { return surface_->to_level(surface_->to_space({x, 0, n})).z(); };
  const Footprint f = release_footprint(*scene_);
  const double height = deepest(*scene_);
  top_ = std::max(level(f.x0, height), level(f.x0, 0));
  start_ = scene_->release.speed();
  double depth = height;
  for (const SideSpec& side : scene_->sides) {
    if (side.kind != SideSpec::Kind::inflow || side.hydrograph.front().time > scene_->duration) continue;
    const GreatestInflow in = greatest_inflow(*scene_, side);
    top_ = std::max(top_, level(0, in.depth));
    start_ = std::max(start_, in.velocity);
    depth = std::max(depth, in.depth);
  }
  front_ = start_ + 2 * std::sqrt(scene_->gravity * depth);
}

// By Ritter's dam break the front of what starts with a velocity has 2 sqrt(g h) more.
double Demands::given(double level) const {
  const double drop = std::max(0.0, top_ - level) + scene_->grains.diameter;
  return front_ * front_ + 2 * scene_->gravity * drop;
}

void Demands::on_window(const WindowReport& w) {
  ++worst_.windows;
  const double mass = w.mass.relative_error();
  worst_.mass = std::max(worst_.mass, mass);
  demand(mass <= round_off, w.time, fmt::format("the mass ledger is off by {:.3g} of all mass", mass));
  // Over the run's largest momentum, known at its end: at its start all momentum is small.
  if (std::abs(w.momentum.residual) > residual_) residual_ = std::abs(w.momentum.residual), residual_time_ = w.time;
  momentum_ = w.momentum.scale;
  demand(w.min_depth >= 0, w.time, fmt::format("a depth of {:.3g} m", w.min_depth));
  worst_.overlap = std::max(worst_.overlap, w.max_overlap);
  worst_.most_grains = std::max(worst_.most_grains, w.grains);
  for (const ObstacleForce& o : w.obstacles)
    for (const double f : o.force) demand(std::isfinite(f), w.time, "a force that is no number");
  for (const double v :
       {w.mass.continuum, w.mass.grains, w.mass.faces, w.mass.left_domain, w.momentum.storage, w.max_speed, w.overtopped})
    demand(std::isfinite(v), w.time, "a figure that is no number");
}

void Demands::on_frame(const FrameView& view) {
  if (view.grains) look_at_grains(view);
  look_at_flow(view);
}

void Demands::look_at_grains(const FrameView& view) {
  const Grains& g = *view.grains;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double v2 = g.vx[i] * g.vx[i] + g.vy[i] * g.vy[i] + g.vz[i] * g.vz[i];
    const double level = surface_->to_level({g.x[i], g.y[i], g.z[i]}).z();
    if (!std::isfinite(v2 + level)) return demand(false, view.time, fmt::format("grain {} is nowhere", g.id[i]));
    const double share = v2 / given(level);
    worst_.fastest = std::max(worst_.fastest, std::sqrt(v2));
    worst_.grain_energy = std::max(worst_.grain_energy, share);
    demand(
        share <= most_energy, view.time,
        fmt::format("grain {} at x = {:.4g}, y = {:.4g}, z = {:.4g} m has {:.3g} m/s, {:.3g} times the energy that it can have",
                    g.id[i], g.x[i], g.y[i], g.z[i], std::sqrt(v2), share));
  }
  const double alone = impact_overlap(*scene_, worst_.fastest);
  if (alone > 0) worst_.overlap_share = std::max(worst_.overlap_share, worst_.overlap / alone);
  demand(worst_.overlap <= most_overlap, view.time,
         fmt::format("grains overlap by {:.3g} d; two alone that meet at the {:.3g} m/s of the fastest make {:.3g} d",
                     worst_.overlap, worst_.fastest, alone));
}

void Demands::look_at_flow(const FrameView& view) {
  const auto look = [&](double x, double y, double h, double hu, double hv, double bed) {
    if (!std::isfinite(h + hu + hv))
      return demand(false, view.time, fmt::format("no number in the cell at x = {:.4g}, y = {:.4g} m", x, y));
    demand(h >= 0, view.time, fmt::format("a depth of {:.3g} m at x = {:.4g}, y = {:.4g} m", h, x, y));
    if (h < least_depth * scene_->grains.diameter) return;
    const double share = (hu * hu + hv * hv) / (h * h) / given(surface_->to_level(surface_->to_space({x, y, bed})).z());
    worst_.flow_energy = std::max(worst_.flow_energy, share);
    demand(share <= most_energy, view.time,
           fmt::format("the flow at x = {:.4g}, y = {:.4g} m, {:.3g} m deep, has {:.3g} times the energy that it can have", x, y,
                       h, share));
  };
  for (int j = 0; j < grid_.ny; ++j)
    for (int i = 0; i < grid_.nx; ++i) {
      const std::size_t k = std::size_t(j) * grid_.nx + i;
      look(grid_.x(i), grid_.y(j), (*view.h)[k], (*view.hu)[k], (*view.hv)[k], bed_[k]);
    }
  if (!view.blocks) return;
  for (const std::vector<double>* field : {&view.blocks->h, &view.blocks->hu, &view.blocks->hv})
    for (const double v : *field) demand(std::isfinite(v), view.time, "no number in a refined cell");
  for (const double h : view.blocks->h) demand(h >= 0, view.time, fmt::format("a depth of {:.3g} m in a refined cell", h));
}

void Demands::on_finish(const RunEnd& end) {
  worst_.residual = momentum_ > 0 ? residual_ / momentum_ : 0;
  demand(worst_.residual <= most_residual, residual_time_,
         fmt::format("the momentum ledger's residual is {:.3g} of the largest momentum", worst_.residual));
  demand(end.status == "done", scene_ ? scene_->duration : 0, "the run ended as " + end.status + ": " + end.reason);
}

}  // namespace couloir
