#include "coupling/engine/contact_law.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "coupling/engine/grain_engine.hpp"

namespace couloir {

namespace {

constexpr double pi = std::numbers::pi;

// Of a spring and damper that part as soon as they would pull; D = c / (2 sqrt(m k)).
double restitution_of(double D) {
  if (D < 1) {
    const double w = std::sqrt(1 - D * D);
    return std::exp(-D / w * std::atan2(2 * D * w, 2 * D * D - 1));  // atan2 joins the paper's two cases below D = 1
  }
  if (D == 1) return std::exp(-2.0);
  const double w = std::sqrt(D * D - 1);
  return std::exp(-D / w * std::log((D + w) / (D - w)));
}

double stiffness(const GrainStiffness& g) {
  return g.youngs_modulus * g.diameter / (20 * (1 - g.poisson_ratio * g.poisson_ratio));
}

}  // namespace

ContactLaw contact_law(const std::string& name) {
  for (const ContactLaw law : {ContactLaw::hertz, ContactLaw::kelvin_voigt})
    if (name == to_string(law)) return law;
  throw std::invalid_argument("no contact law is called " + name);
}

const char* to_string(ContactLaw law) {
  return law == ContactLaw::hertz ? "hertz" : "kelvin_voigt";
}

std::string contact_name(ContactLaw law, bool tangential_damping) {
  return std::string(to_string(law)) + (tangential_damping ? "" : "-undamped");
}

double damping_ratio(double restitution) {
  if (restitution >= 1) return 0;
  double low = 0, high = 100;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (restitution_of(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double restitution_with_tension(double restitution) {
  const double D = damping_ratio(restitution);
  return D < 1 ? std::exp(-pi * D / std::sqrt(1 - D * D)) : 0;
}

LinearContact linear_contact(const GrainStiffness& g, double restitution) {
  const double mass = grain_mass(0.5 * g.diameter, g.density), ratio = damping_ratio(restitution);
  LinearContact c;
  c.stiffness = stiffness(g);
  c.shear_stiffness = c.stiffness * 2 * (1 - g.poisson_ratio) / (2 - g.poisson_ratio);
  c.damping = 2 * ratio * std::sqrt(0.5 * mass * c.stiffness);
  c.shear_damping = 2 * ratio * std::sqrt(0.5 * mass * c.shear_stiffness);
  c.surface_damping = 2 * ratio * std::sqrt(mass * c.stiffness);
  c.surface_shear_damping = 2 * ratio * std::sqrt(mass * c.shear_stiffness);
  return c;
}

double stable_timestep(ContactLaw law, const GrainStiffness& g) {
  const double radius = 0.5 * g.diameter * (1 - g.spread);
  if (law == ContactLaw::kelvin_voigt) return pi * std::sqrt(0.5 * grain_mass(radius, g.density) / stiffness(g)) / 20;
  const double shear_modulus = g.youngs_modulus / (2 * (1 + g.poisson_ratio));
  return 0.16 * pi * radius * std::sqrt(g.density / shear_modulus) / (0.1631 * g.poisson_ratio + 0.8766);
}

}  // namespace couloir
