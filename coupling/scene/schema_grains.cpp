// Keys of the grains: their engine, how they push and turn, what they are made of.

#include <tuple>

#include "coupling/scene/schema_builder.hpp"

namespace couloir::schema_builder {
namespace {

using enum Dimension;

template <class Member>
auto at(Member member) {
  return [=](auto& s, int) -> auto& {
    return s.grains.*member;
  };
}

template <class Member>
auto control(Member member) {
  return [=](auto& s, int) -> auto& {
    return s.grains.control.*member;
  };
}

void add_rotation(Keys& k) {
  Key rule =
      mapping("grains.rotation",
              "whether grains turn: free; blocked, not at all; or a mapping, for spheres that stand for angular grains: a "
              "grain with c >= 1 contacts, surfaces included, loses its spin as k^(t/lambda), k = 1 / (1 + c^chi), lambda = "
              "k_v v_s + lambda_c, (4.11)-(4.13), where v_s is the speed of its centre along its contacts relative to the "
              "others. Rolling friction goes on beside it. yade looks every 20 steps at most")
          .build();
  rule.choices = {"free", "blocked"};
  rule.get = [](const Scene& s, int) -> Value { return s.grains.rotation == "control" ? "" : s.grains.rotation; };
  rule.set = [](Scene& s, int, const Value& value) { s.grains.rotation = std::get<std::string>(value); };
  k.add(rule);
  Key law = mapping("grains.rotation.control", "the law's parameters; the dissertation gives no values").required().build();
  law.enter = [](Scene& s, int) { s.grains.rotation = "control"; };
  k.add(law);
  const std::string path = "grains.rotation.control.";
  k.add(number(path + "retarding_time", time, "lambda_c: within it a spin becomes k times itself",
               control(&RotationSpec::retarding_time))
            .above(0)
            .upto(1e6)
            .required());
  k.add(number(path + "contact_influence", none, "chi; 0: the same however many contacts",
               control(&RotationSpec::contact_influence))
            .within(0, 10));
  k.add(number(path + "shear_influence", time_per_velocity, "k_v: by which shear makes the retarding time longer",
               control(&RotationSpec::shear_influence))
            .within(0, 1e6));
  k.add(number(path + "slide_to_roll", velocity, "v_sr: a grain that touches others without spin has none below it; 0: never so",
               control(&RotationSpec::slide_to_roll))
            .within(0, 1e3));
  k.add(number(path + "roll_to_slide", velocity, "v_rs, at most v_sr: a grain that spins loses its spin below it",
               control(&RotationSpec::roll_to_slide))
            .within(0, 1e3));
}

void add_box(Keys& k, const std::string& path) {
  const auto box = [](auto& s, int i) -> auto& {
    return s.grains.zones[static_cast<std::size_t>(i)];
  };
  k.add(numbers(path + "x", length, "[from, to] along the slope", [box](auto& s, int i) {
          return std::tie(box(s, i).x0, box(s, i).x1);
        }).required());
  k.add(numbers(path + "y", length, "[from, to] across the slope", [box](auto& s, int i) {
          return std::tie(box(s, i).y0, box(s, i).y1);
        }).required());
}

}  // namespace

// A material's grain parameters; `prefix` is where they are written, there or as overrides in the scene's grains.
void add_grain_material(Keys& k, const std::string& prefix, Presence presence) {
  const auto add = [&](const char* name, Dimension dimension, const char* help, Bounds bounds, auto member,
                       const char* word_for_0 = "") {
    const auto at = [member](auto& s, int) -> auto& {
      return s.material.grain.*member;
    };
    KeyBuilder key = number(prefix + name, dimension, help, at).bounded(bounds).with(presence);
    if (*word_for_0) key.or_word(word_for_0);
    k.add(presence == Presence::optional ? key.unwritten() : key);
  };
  using G = GrainMaterial;
  add("friction", none, "Coulomb friction between grains", {0, 5}, &G::friction);
  add("base_friction", none, "Coulomb friction of a grain on the bed", {0, 5}, &G::base_friction);
  add("wall_friction", none, "Coulomb friction of a grain on an obstacle", {0, 5}, &G::wall_friction);
  add("side_friction", none, "Coulomb friction of a grain on a side wall", {0, 5}, &G::side_friction);
  add("rolling_friction", none, "rolling friction between grains", {0, 5}, &G::rolling_friction);
  add("base_rolling_friction", none, "rolling friction of a grain on bed, obstacles and sides", {0, 5},
      &G::base_rolling_friction);
  add("restitution", none, "coefficient of restitution; LIGGGHTS takes none of 0.05 or less", {0.05, 1, true}, &G::restitution);
  add("youngs_modulus", pressure,
      "stiffness of a grain; auto: as the flow's expected speed asks, so that grains which come in a bunch overlap by at most a "
      "tenth of their diameter; LIGGGHTS takes no less than 5 MPa",
      {5e6, 1e12}, &G::youngs_modulus, "auto");
  add("poisson_ratio", none, "Poisson's ratio of a grain", {0, 0.49}, &G::poisson_ratio);
}

void add_grains(Keys& k) {
  k.add(mapping("grains", "the discrete-element engine; needed in the modes coupled and grains"));
  k.add(word("grains.engine", "which engine; yade runs on one rank", {"liggghts", "yade"}, at(&GrainSpec::engine)));
  k.add(word("grains.contact",
             "how grains push: hertz, Hertz-Mindlin with rolling friction; kelvin_voigt, the dissertation's spring and damper "
             "(section 4.3) with Coulomb friction and without tension or rolling friction, its stiffness E d / (20 (1 - nu^2))",
             {"hertz", "kelvin_voigt"}, at(&GrainSpec::contact)));
  k.add(choice(
      "grains.tangential_damping",
      "the damper along a contact, which pulls beside the spring until that has come to Coulomb's limit; off: a grain that "
      "slides on impact loses mu (1 + e) v_n and no more, and liggghts's hertz does not pull at a contact's end",
      {"off", "on"}, at(&GrainSpec::tangential_damping)));
  add_rotation(k);
  k.add(integer("grains.ranks", "MPI ranks of the engine", at(&GrainSpec::ranks)).within(1, 1024));
  k.add(number("grains.diameter", length, "mean diameter of a simulated grain", at(&GrainSpec::diameter)).above(0).optional());
  k.add(number("grains.spread", none, "radii are uniform within +-spread of the mean", at(&GrainSpec::spread)).within(0, 0.5));

  Key zone = mapping("grains.zone", "where grains replace the continuum: auto (around the obstacles) or a box").build();
  zone.choices = {"auto"};
  zone.get = [](const Scene& s, int) -> Value { return s.grains.zones.size() == 1 ? "" : "auto"; };
  zone.set = [](Scene& s, int, const Value&) { s.grains.zones.clear(); };
  zone.enter = [](Scene& s, int) { s.grains.zones.assign(1, {}); };
  k.add(zone);
  add_box(k, "grains.zone.");
  Key zones = list(
                  "grains.zones", "several boxes instead of grains.zone, each with an engine of its own",
                  [](auto& s) -> auto& { return s.grains.zones; })
                  .build();
  zones.entries = [all = zones.entries](const Scene& s, int of) {  // one is grains.zone
    return s.grains.zones.size() == 1 ? std::vector<Entry>() : all(s, of);
  };
  k.add(zones);
  add_box(k, "grains.zones.*.");

  k.add(choice(
      "grains.follow",
      "whether the zone follows the need: it grows where a jump or a dead zone nears a face, shrinks back, and its engine ends "
      "when all grains are at rest or gone",
      {"off", "on"}, at(&GrainSpec::follow)));
  k.add(integer("grains.window", "engine steps in a coupling window", at(&GrainSpec::window)).within(1, 100000));
  k.add(number("grains.timestep", time,
               "of the engine; 0: a fixed share of the Rayleigh time (hertz) or of the contact time (kelvin_voigt)",
               at(&GrainSpec::timestep))
            .within(0, 1));
  k.add(number("grains.skin", length,
               "of the neighbour lists, which are made anew when a grain has gone half of it; 0: 0.3 d (liggghts), "
               "0.25 d (yade) of the largest grain",
               at(&GrainSpec::skin))
            .within(0, 10));
  k.add(integer("grains.seed", "of the packing and the radii", at(&GrainSpec::seed)).within(1, 2147483647));
  k.add(
      integer(
          "grains.replicates",
          "runs, each with a packing of its own (seeds from grains.seed upward): every figure of force gets a mean and a scatter",
          at(&GrainSpec::replicates))
          .within(1, 1000));
  k.add(number("grains.timeout", time, "without an answer before the engine counts as dead; of the clock, never scaled",
               at(&GrainSpec::timeout))
            .within(1, 86400)
            .unscaled());
  add_grain_material(k, "grains.", Presence::optional);
}

}  // namespace couloir::schema_builder
