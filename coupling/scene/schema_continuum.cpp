// Keys of the depth-averaged solver: its scheme, its mesh, and where cells are finer.

#include <tuple>

#include "continuum/mesh/most_levels.hpp"
#include "coupling/scene/schema_builder.hpp"

namespace couloir::schema_builder {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

template <class Member>
auto at(Member member) {
  return [=](auto& s, int) -> auto& {
    return s.continuum.*member;
  };
}

void add_solver(Keys& k) {
  using C = ContinuumSpec;
  k.add(mapping("continuum", "the depth-averaged solver"));
  k.add(word("continuum.scheme", "central_upwind, or noc: the staggered scheme (3.2)-(3.23), mode continuum only",
             {"central_upwind", "noc"}, at(&C::scheme)));
  k.add(number("continuum.cell", Dimension::length, "edge of a cell; adjusted so that the domain holds a whole number",
               at(&C::cell))
            .above(0)
            .optional());
  k.add(number("continuum.cell_across", Dimension::length, "its length across the slope, where it differs from the one along it",
               at(&C::cell_across))
            .above(0)
            .optional());
  k.add(number("continuum.cfl", Dimension::none,
               "Courant number; at 0.5 ends the positivity of central_upwind, and the bound (3.22) of noc", at(&C::cfl))
            .above(0)
            .upto(0.5));
  k.add(word("continuum.closure", "earth pressure: (2.83)-(2.86), or K = 1", {"active_passive", "hydraulic"}, at(&C::closure)));
  k.add(word("continuum.limiter", "of the reconstruction; eno with scheme noc only",
             {"minmod", "van_leer", "mc", "superbee", "eno"}, at(&C::limiter)));
  k.add(word("continuum.curvature", "the term kappa u^2 in the friction; automatic: where the surface has an arc",
             {"automatic", "on", "off"}, at(&C::curvature)));
}

void add_boxes(Keys& k) {
  const std::string path = "continuum.refine.*.";
  const auto at = [](auto member) {
    return [=](auto& s, int i) -> auto& {
      return s.continuum.refine[i].*member;
    };
  };
  const auto reach = [&](const char* name, const char* help, double RefineSpec::*member) {
    k.add(number(path + name, Dimension::length, help, at(member)).within(0, endless));
  };
  k.add(list(
      "continuum.refine", "rectangles of finer cells, which stay where they are",
      [](auto& s) -> auto& { return s.continuum.refine; }));
  k.add(
      text(path + "around", "name of the obstacle about whose base the rectangle lies; or give x and y", at(&RefineSpec::around))
          .optional());
  reach("up", "how far it reaches up the slope from the base's front edge", &RefineSpec::up);
  reach("down", "how far it reaches down the slope", &RefineSpec::down);
  reach("left", "how far it reaches beyond the base to low y", &RefineSpec::left);
  reach("right", "how far it reaches beyond the base to high y", &RefineSpec::right);
  k.add(choice(path + "from", "what down counts from: the downstream edge of the base, or its front edge", {"base", "front"},
               at(&RefineSpec::from)));
  k.add(numbers(path + "x", Dimension::length, "[from, to] along the slope, without an obstacle", [](auto& s, int i) {
          auto& r = s.continuum.refine[i];
          return std::tie(r.x0, r.x1);
        }).optional());
  k.add(numbers(path + "y", Dimension::length, "[from, to] across the slope, without an obstacle", [](auto& s, int i) {
          auto& r = s.continuum.refine[i];
          return std::tie(r.y0, r.y1);
        }).optional());
  k.add(integer(path + "levels", "how often the cells are halved", at(&RefineSpec::levels)).within(1, most_levels));
  reach("margin",
        "by how much each coarser rectangle is larger than the next; 0: what whole blocks give (noc: five of its cells)",
        &RefineSpec::margin);
}

void add_adaptive(Keys& k) {
  const std::string path = "continuum.adapt.";
  const auto at = [](auto member) {
    return [=](auto& s, int) -> auto& {
      return s.continuum.adapt.*member;
    };
  };
  Key section =
      mapping("continuum.adapt", "finer cells where the flow asks for them, scheme central_upwind: off, or by which signs")
          .build();
  section.choices = {"off"};
  section.get = [](const Scene& s, int) -> Value { return s.continuum.adapt.levels > 0 ? "" : "off"; };
  section.set = [](Scene& s, int, const Value&) { s.continuum.adapt.levels = 0; };
  k.add(section);
  k.add(integer(path + "levels", "how often the cells may be halved", at(&AdaptSpec::levels)).within(1, most_levels).required());
  k.add(integer(path + "interval", "steps of the coarsest cells between two looks", at(&AdaptSpec::interval)).within(1, 10000));
  k.add(choice(path + "front", "where the outline of the flow advances or rests", {"off", "on"}, at(&AdaptSpec::front)));
  k.add(number(path + "gradient", Dimension::none,
               "where the surface changes from cell to cell by this share of the flow's greatest depth; 0: never",
               at(&AdaptSpec::gradient))
            .within(0, 1));
  k.add(number(path + "obstacle", Dimension::length, "as far about obstacles, once the flow is as near; 0: never",
               at(&AdaptSpec::obstacle))
            .within(0, endless));
  k.add(choice(path + "zone", "along the rim of the grains' zone", {"off", "on"}, at(&AdaptSpec::zone)));
}

}  // namespace

void add_continuum(Keys& k) {
  add_solver(k);
  k.add(
      integer("continuum.block",
              "cells along the edge of a block of scheme central_upwind; with refinement a multiple of 2^levels; none: 32, with "
              "refinement 16 or what the levels need",
              at(&ContinuumSpec::block))
          .within(4, 256)
          .optional());
  add_boxes(k);
  add_adaptive(k);
}

}  // namespace couloir::schema_builder
