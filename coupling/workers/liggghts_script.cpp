#include "coupling/workers/liggghts_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

#include "coupling/workers/engine_errors.hpp"

namespace couloir {

namespace {

std::string surface_file(const EngineSetup& s, std::size_t k) {
  return fmt::format("{}/surface_{}.stl", s.work_dir, k);
}

// The box, and around the surfaces: the engine loses triangles that stick out. Grains are held to the box itself elsewhere.
std::string box_region(const EngineSetup& s) {
  Vec lo = s.lo, hi = s.hi;
  for (const EngineSurface& surface : s.surfaces) {
    for (const Triangle& t : surface.triangles) {
      for (int k = 0; k < 3; ++k) {
        if (s.periodic[k]) continue;
        lo[k] = std::min({lo[k], t.a[k] - s.max_radius, t.b[k] - s.max_radius, t.c[k] - s.max_radius});
        hi[k] = std::max({hi[k], t.a[k] + s.max_radius, t.b[k] + s.max_radius, t.c[k] + s.max_radius});
      }
    }
  }
  return fmt::format("region box block {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} units box", lo[0], hi[0], lo[1], hi[1],
                     lo[2], hi[2]);
}

// One number for every pair of materials: type 1 the grains, type 2 + k surface k.
std::string pair_property(const char* id, const char* property, const EngineSetup& s, double grains,
                          const std::function<double(const EngineSurface&)>& of_surface) {
  const std::size_t types = s.surfaces.size() + 1;
  std::string text = fmt::format("fix {} all property/global {} peratomtypepair {}", id, property, types);
  for (std::size_t i = 0; i < types; ++i) {
    for (std::size_t j = 0; j < types; ++j) {
      const std::size_t surface = std::max(i, j);  // two surfaces never touch
      text += fmt::format(" {:.17g}", surface == 0 ? grains : of_surface(s.surfaces[surface - 1]));
    }
  }
  return text;
}

std::string pair_property(const char* id, const char* property, const EngineSetup& s, double grains, double surfaces) {
  return pair_property(id, property, s, grains, [surfaces](const EngineSurface&) { return surfaces; });
}

std::string type_property(const char* id, const char* property, const EngineSetup& s, double value) {
  std::string text = fmt::format("fix {} all property/global {} peratomtype", id, property);
  for (std::size_t i = 0; i < s.surfaces.size() + 1; ++i) text += fmt::format(" {:.17g}", value);
  return text;
}

}  // namespace

std::vector<std::string> liggghts_script(const EngineSetup& s, const std::string& checkpoint, std::int64_t step) {
  const bool hertz = s.contact == ContactLaw::hertz;
  const std::string model =
      hertz ? "model hertz tangential history rolling_friction epsd2" : "model hooke/stiffness tangential history";
  // Behind the model's name, and of a wall's behind its meshes. Where hertz pulls, friction acts on: Coulomb's limit takes |F_n|.
  const bool undamped = !s.tangential_damping;
  const std::string settings = std::string(hertz ? "" : " absolute_damping on") + (hertz && !undamped ? "" : " limitForce on") +
                               (undamped ? " tangential_damping off" : "");
  const double restitution = hertz && undamped ? restitution_with_tension(s.restitution) : s.restitution;
  const auto side = [&](int k) { return s.periodic[k] ? "p" : "f"; };
  std::vector<std::string> script = {
      "units si",
      "atom_style granular",
      "atom_modify map array",
      fmt::format("boundary {} {} {}", side(0), side(1), side(2)),
      "newton off",
      "communicate single vel yes",
      "processors * * 1",  // flows are shallow
  };
  if (checkpoint.empty()) {
    script.push_back(box_region(s));
    script.push_back(fmt::format("create_box {} box", s.surfaces.size() + 1));
    if (step > 0) script.push_back(fmt::format("reset_timestep {}", step));
  } else {
    script.push_back("read_restart " + checkpoint);
  }
  // Flows shear: a third of a diameter rebuilds the lists seldom enough without making them long.
  const double skin = s.skin > 0 ? s.skin : 0.6 * s.max_radius;
  script.push_back(fmt::format("neighbor {:.17g} bin", skin));
  // Bins as wide as the reach of a contact: the engine's own choice, half of it, makes too many empty ones in a high box.
  script.push_back(fmt::format("neigh_modify delay 0 binsize {:.17g}", 2 * s.max_radius + skin));
  script.push_back(type_property("material_1", "youngsModulus", s, s.youngs_modulus));
  script.push_back(type_property("material_2", "poissonsRatio", s, s.poisson_ratio));
  script.push_back(pair_property("material_3", "coefficientRestitution", s, restitution, restitution));
  script.push_back(pair_property("material_4", "coefficientFriction", s, s.friction, &EngineSurface::friction));
  script.push_back(
      pair_property("material_5", "coefficientRollingFriction", s, s.rolling_friction, &EngineSurface::rolling_friction));
  if (!hertz) {
    const LinearContact& c = s.linear;
    script.push_back(pair_property("material_6", "kn", s, c.stiffness, c.stiffness));
    script.push_back(pair_property("material_7", "kt", s, c.shear_stiffness, c.shear_stiffness));
    script.push_back(pair_property("material_8", "gamman_abs", s, c.damping, c.surface_damping));
    script.push_back(pair_property("material_9", "gammat_abs", s, c.shear_damping, c.surface_shear_damping));
  }
  script.push_back("pair_style gran " + model + settings);
  script.push_back("pair_coeff * *");
  script.push_back(fmt::format("timestep {:.17g}", s.timestep));
  if (const double g = std::hypot(s.gravity[0], s.gravity[1], s.gravity[2]); g > 0) {
    script.push_back(fmt::format("fix weight all gravity {:.17g} vector {:.17g} {:.17g} {:.17g}", g, s.gravity[0], s.gravity[1],
                                 s.gravity[2]));
  }
  std::string meshes;
  for (std::size_t k = 0; k < s.surfaces.size(); ++k) {
    script.push_back(fmt::format("fix mesh_{} all mesh/surface/stress file {} type {}", k, surface_file(s, k), k + 2));
    meshes += fmt::format(" mesh_{}", k);
  }
  script.push_back("fix probe_before all couloir/probe clear");
  script.push_back("fix zone_before all couloir/zone_force before");
  if (!meshes.empty())
    script.push_back(
        fmt::format("fix walls all wall/gran {} mesh n_meshes {} meshes{}{}", model, s.surfaces.size(), meshes, settings));
  script.push_back("fix zone_after all couloir/zone_force after");
  script.push_back("fix probe all couloir/probe read");
  if (s.rotation != Rotation::free) script.push_back("fix rotation all couloir/rotation");
  script.push_back("fix integrate all nve/sphere");
  script.push_back(fmt::format("fix exchange all couloir/exchange {:.17g}", s.max_radius));
  script.push_back("fix drive all couloir/drive");
  script.push_back("fix heartbeat all couloir/heartbeat");
  script.push_back("thermo 1000000000");
  script.push_back("thermo_modify lost ignore norm no");
  return script;
}

void write_surfaces(const EngineSetup& s) {
  for (std::size_t k = 0; k < s.surfaces.size(); ++k) {
    const std::string name = surface_file(s, k);
    std::ofstream out(name);
    out << "solid surface\n";
    const auto vertex = [&](const Vec& v) { out << fmt::format("      vertex {:.17g} {:.17g} {:.17g}\n", v[0], v[1], v[2]); };
    for (const Triangle& t : s.surfaces[k].triangles) {
      out << "  facet normal 0 0 0\n    outer loop\n";
      vertex(t.a);
      vertex(t.b);
      vertex(t.c);
      out << "    endloop\n  endfacet\n";
    }
    out << "endsolid surface\n";
    out.close();
    if (!out) throw EngineFailure("the surface file " + name + " cannot be written", false);
  }
}

}  // namespace couloir
