#include "coupling/loop/energy_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

#include "continuum/errors.hpp"

namespace couloir {
namespace {

constexpr double deep_overlap = 0.3;  // [-] impacts of soft grains stay below it
constexpr double most_overlap = 0.5;  // [-] a radius: what lies deeper in each other may pass through

double length(const Vec& v) {
  return std::hypot(v[0], v[1], v[2]);
}

double fastest_drive(const AdvanceRequest& request, const Advanced& advanced) {
  double most = 0, along = 0;
  for (const auto& face : advanced.segments)
    for (const SegmentReport& s : face) most = std::max(most, std::abs(s.velocity));
  for (const auto& face : request.drives)
    for (const SegmentDrive& d : face)
      most = std::max({most, std::abs(d.most), d.exit_active ? length(d.exit_velocity) : 0.0}),
      along = std::max({along, std::abs(d.along), std::abs(d.slide)});
  return std::hypot(most, along);
}

}  // namespace

EnergyGuard::EnergyGuard(const EngineSetup& s, double stable_step)
    : gravity_(s.gravity), density_(s.density), diameter_(2 * s.max_radius), timestep_(s.timestep), stable_step_(stable_step) {}

double EnergyGuard::kinetic_and_potential(double mass, const Vec& x, const Vec& v) const {
  const double speed = length(v);
  return mass * (0.5 * speed * speed - gravity_[0] * x[0] - gravity_[1] * x[1] - gravity_[2] * x[2]);
}

double EnergyGuard::brought(const AdvanceRequest& request, const Grains& g) const {
  double sum = 0;
  for (const NewGrain& n : request.insert) {
    const double mass = grain_mass(n.radius, density_), rim_speed = n.radius * length(n.spin);
    sum += kinetic_and_potential(mass, n.position, n.velocity) + 0.2 * mass * rim_speed * rim_speed;
  }
  const std::unordered_set<std::int64_t> removed(request.remove.begin(), request.remove.end());
  if (removed.empty()) return sum;
  for (std::size_t i = 0; i < g.size(); ++i) {  // their spin is not known: it stays in, as energy lost
    if (!removed.contains(g.id[i])) continue;
    sum -= kinetic_and_potential(grain_mass(g.radius[i], density_), {g.x[i], g.y[i], g.z[i]}, {g.vx[i], g.vy[i], g.vz[i]});
  }
  return sum;
}

void EnergyGuard::look(const AdvanceRequest& request, const Grains& before, const Advanced& a) {
  if (a.max_overlap > most_overlap)
    throw NumericsError(fmt::format("by step {} two grains overlap by {:.2g} d, more than a radius: {}", a.step, a.max_overlap,
                                    cause(a.max_overlap)));
  double energy = a.kinetic_energy, weight = 0;
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    const double mass = grain_mass(a.grains.radius[i], density_);
    energy += kinetic_and_potential(mass, {a.grains.x[i], a.grains.y[i], a.grains.z[i]}, {});
    weight += mass * length(gravity_);
  }
  const double driven = length(a.drive_impulse) * fastest_drive(request, a);
  const double gain = energy - state_.energy - brought(request, before) - driven;
  state_.energy = energy;
  state_.unexplained = std::max(0.0, state_.unexplained + gain);
  state_.most_kinetic = std::max(state_.most_kinetic, a.kinetic_energy - state_.unexplained);
  if (state_.unexplained > state_.most_kinetic + weight * diameter_) {
    throw NumericsError(
        fmt::format("by step {} the grains have {:.3g} J that nothing gave them (at most {:.3g} J of motion are explained; "
                    "largest overlap {:.2g} d): {}",
                    a.step, state_.unexplained, state_.most_kinetic, a.max_overlap, cause(a.max_overlap)));
  }
}

std::string EnergyGuard::cause(double overlap) const {
  if (timestep_ > stable_step_) {
    return fmt::format(
        "the time step of {:.3g} us is {:.2f} times the stable one of {:.3g} us; lower grains.timestep or leave it out",
        timestep_ * 1e6, timestep_ / stable_step_, stable_step_ * 1e6);
  }
  if (overlap > deep_overlap) {
    return "grains overlap where they were put in, or are too soft for their speed; raise grains.youngs_modulus, or move what "
           "they overlap";
  }
  return "lower grains.timestep or raise grains.youngs_modulus";
}

void EnergyGuard::explain(const RunawayError& error) const {
  const std::string what = error.what();
  throw NumericsError(fmt::format("{}; {}", what.substr(0, what.find('\n')), cause(0)));
}

}  // namespace couloir
