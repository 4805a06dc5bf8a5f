#pragma once
// How grains push each other: the laws that a scene may choose, the same in both engines.

#include <string>

namespace couloir {

enum class ContactLaw { hertz, kelvin_voigt };

// The law of that name, as grains.contact has it. Throws std::invalid_argument.
ContactLaw contact_law(const std::string& name);
const char* to_string(ContactLaw);

// The law's name where it is told apart from others: hertz, or hertz-undamped without damping along its contacts.
std::string contact_name(ContactLaw, bool tangential_damping);

// The dissertation's law (section 4.3): a spring beside a damper, along the normal and along the contact's plane,
//
//   F_n = max(0, k_n d + c_n d'),   F_t = k_t s + c_t s',   |k_t s| <= mu F_n (4.10)
//
// d overlap [m], s elastic shear displacement [m]. Surfaces are rigid: a grain on one has the same springs and its whole mass.
struct LinearContact {
  double stiffness = 0, shear_stiffness = 0;              // [N/m] k_n, k_t
  double damping = 0, shear_damping = 0;                  // [N s/m] c_n, c_t of two grains of the mean diameter
  double surface_damping = 0, surface_shear_damping = 0;  // [N s/m] of such a grain on a surface
};

// What a linear contact is derived from, and its time step.
struct GrainStiffness {
  double diameter = 0, spread = 0;  // [m] mean; [-] of the radii
  double density = 0;               // [kg/m3] of a grain
  double youngs_modulus = 0;        // [Pa]
  double poisson_ratio = 0;
};

// k_n is the stiffness of a Hertz contact whose overlap is 1 % of the diameter, E d / (20 (1 - nu^2)); k_t / k_n is Mindlin's
// ratio 2 (1 - nu) / (2 - nu). The damping gives the restitution asked for.
LinearContact linear_contact(const GrainStiffness&, double restitution);

// c / (2 sqrt(m k)) of a spring and damper without tension that give this restitution, in 0.05..1: Schwager & Poeschel,
// Granular Matter 9 (2007) 465, eq. (21), solved for it.
double damping_ratio(double restitution);

// What a contact that may pull at its end gives, exp(-pi D / sqrt(1 - D^2)), where one that may not, with the same damping ratio
// D, gives `restitution`, above 0.136 (D < 1). Both for a linear spring and for LIGGGHTS's hertz, whose damping goes with the
// fourth root of the overlap: with y = d^(5/4) it is a linear one in the plane of y and velocity (Antypov & Elliott, EPL 94
// (2011) 50004).
double restitution_with_tension(double restitution);

// [s] that resolves the asked restitution: hertz 0.16 of the Rayleigh time of the smallest grain (measured: 0.30 misses it);
// kelvin_voigt a twentieth of the contact time pi sqrt(m / 2 k_n) of two such grains.
double stable_timestep(ContactLaw, const GrainStiffness&);

}  // namespace couloir
