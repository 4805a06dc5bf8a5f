// Keys of the obstacles: bodies, meshes, gauges on their fronts.

#include <tuple>

#include "coupling/scene/schema_builder.hpp"

namespace couloir::schema_builder {
namespace {

using enum Dimension;

void add_stress_gauges(Keys& k) {
  const auto centre = [](auto& s, int i) {
    auto& g = s.stress_gauges[i];
    return std::tie(g.across, g.up);
  };
  const auto size = [](auto& s, int i) {
    auto& g = s.stress_gauges[i];
    return std::tie(g.width, g.height);
  };
  KeyBuilder gauges = named(
      "obstacles.*.gauges",
      "parts of a cuboid's upstream face on which the grains' normal and shear stresses are recorded; modes coupled and grains",
      [](auto& s) -> auto& { return s.stress_gauges; });
  gauges.key().entries = [](const Scene& s, int of) {
    std::vector<Entry> entries;
    for (std::size_t n = 0; n < s.stress_gauges.size(); ++n) {
      if (s.stress_gauges[n].obstacle == of) entries.push_back({s.stress_gauges[n].name, static_cast<int>(n)});
    }
    return entries;
  };
  gauges.key().append = [append = gauges.key().append](Scene& s, int of, const std::string& name) {
    const int index = append(s, of, name);
    s.stress_gauges[index].obstacle = of;
    return index;
  };
  k.add(gauges);
  k.add(numbers("obstacles.*.gauges.*.centre", length,
                "[across, up] its middle: from the face's middle to high y, and over the face's foot", centre)
            .required());
  k.add(numbers("obstacles.*.gauges.*.size", length, "[across, up] of a rectangle; or give a radius", size).above(0).optional());
  k.add(number(
            "obstacles.*.gauges.*.radius", length,
            "of a round one: a polygon of 16 sides around it is taken, its area 1.3 % larger",
            [](auto& s, int i) -> auto& { return s.stress_gauges[i].radius; })
            .above(0)
            .optional());
}

// A table whose rows of three are entries of a vector of the obstacle.
template <class Number>
Key triples(const std::string& path, const std::string& help, Dimension dimension, const std::vector<std::string>& columns,
            std::vector<std::array<Number, 3>> ObstacleSpec::*member) {
  Key key;
  key.path = path;
  key.kind = ValueKind::table;
  key.help = help;
  key.columns = {dimension, dimension, dimension};
  key.column_names = columns;
  key.presence = Presence::optional;
  key.selector = "shape";
  key.selected = {"mesh"};
  key.get = [=](const Scene& s, int i) -> Value {
    std::vector<double> out;
    for (const auto& row : s.obstacles[i].*member)
      for (const Number x : row) out.push_back(static_cast<double>(x));
    return out;
  };
  key.set = [=](Scene& s, int i, const Value& value) {
    const auto& list = std::get<std::vector<double>>(value);
    auto& rows = s.obstacles[i].*member;
    rows.clear();
    for (std::size_t n = 0; n + 2 < list.size(); n += 3)
      rows.push_back({static_cast<Number>(list[n]), static_cast<Number>(list[n + 1]), static_cast<Number>(list[n + 2])});
  };
  return key;
}

void add_mesh(Keys& k) {
  k.add(text(
            "obstacles.*.file",
            "STL file, text or binary, its name counted from the scene's folder: a closed surface, all triangles looking out, "
            "z along the normal from the bed at 0, x along the slope; what reaches below the bed is cut off",
            [](auto& s, int i) -> auto& { return s.obstacles[i].file; })
            .optional()
            .when("shape", {"mesh"}));
  k.add(word(
            "obstacles.*.unit", "of the file's numbers, which have none", {"mm", "cm", "m"},
            [](auto& s, int i) -> auto& { return s.obstacles[i].unit; })
            .when("shape", {"mesh"}));
  k.add(number(
            "obstacles.*.rotation", angle, "about the normal, counter-clockwise seen from above",
            [](auto& s, int i) -> auto& { return s.obstacles[i].rotation; })
            .within(-360 * deg * (1 + 1e-9), 360 * deg * (1 + 1e-9))
            .when("shape", {"mesh"}));
  Key vertices =
      triples("obstacles.*.vertices",
              "corners [x, y, z] in the file's frame, in metres or with units; with these and faces no file is read: so "
              "a run's own scene keeps the body",
              length, {"x", "y", "z"}, &ObstacleSpec::vertices);
  vertices.scaled = false;
  vertices.bounds = {-1e6, 1e6, false};
  k.add(vertices);
  Key faces =
      triples("obstacles.*.faces", "triangles, each three numbers of vertices, counted from 0, counter-clockwise from outside",
              none, {"first", "second", "third"}, &ObstacleSpec::faces);
  faces.scaled = false;
  faces.bounds = {0, 1e6, false};
  k.add(faces);
}

}  // namespace

void add_obstacles(Keys& k) {
  const auto position = [](auto& s, int i) {
    auto& o = s.obstacles[i];
    return std::tie(o.x, o.y);
  };
  const auto size = [](auto& s, int i) {
    auto& o = s.obstacles[i];
    return std::tie(o.length, o.width, o.height);
  };
  k.add(named(
      "obstacles", "solid bodies on the bed, by names of your choice", [](auto& s) -> auto& { return s.obstacles; }));
  KeyBuilder shape = choice(
      "obstacles.*.shape",
      "cuboid; tetrahedron: a wedge on a triangle with one corner upstream, its peak above the "
      "triangle's centre, (4.2)-(4.5); mesh: a body of any shape from an STL file",
      {"cuboid", "tetrahedron", "mesh"}, [](auto& s, int i) -> auto& { return s.obstacles[i].shape; });
  shape.key().set = [set = shape.key().set](Scene& s, int i, const Value& value) {
    using enum ObstacleSpec::Shape;
    using enum ObstacleSpec::Method;
    set(s, i, value);
    s.obstacles[i].method = s.obstacles[i].shape == tetrahedron ? elevation : step;
  };
  k.add(shape);
  k.add(
      numbers("obstacles.*.position", length,
              "[x, y] of the middle of the upstream edge of the footprint; tetrahedron: of its upstream corner; mesh: of the box "
              "around it as it stands",
              position)
          .required());
  k.add(numbers("obstacles.*.size", length,
                "[along, across, normal] of the base and the height; tetrahedron: an equilateral base of edge L is [0.8660254 L, "
                "L, height]",
                size)
            .above(0)
            .required()
            .when("shape", {"cuboid", "tetrahedron"}));
  add_mesh(k);
  k.add(choice(
      "obstacles.*.method",
      "of the continuum; step: the bed jumps, nothing flows through; elevation: a smooth bed height, (4.4)-(4.9), as a "
      "tetrahedron always is; both take a mesh's upper surface at the cells' centres; planes: a cuboid of five planes of their "
      "own, on which the flow climbs and falls back",
      {"step", "elevation", "planes"}, [](auto& s, int i) -> auto& { return s.obstacles[i].method; }));
  k.add(number(
            "obstacles.*.ramp", length,
            "of a cuboid: its sides rise within this length inside its base, (4.6); none: one cell, at most a quarter of the "
            "shorter edge",
            [](auto& s, int i) -> auto& { return s.obstacles[i].ramp; })
            .above(0)
            .optional()
            .when("method", {"elevation"}));
  k.add(number(
            "obstacles.*.eta", none, "share of the velocity that the edge between slope and front plane passes on",
            [](auto& s, int i) -> auto& { return s.obstacles[i].eta; })
            .within(0, 1)
            .when("method", {"planes"}));
  k.add(word(
            "obstacles.*.overflow", "what to do when material comes over the upper edges, which the method cannot describe",
            {"warn", "error"}, [](auto& s, int i) -> auto& { return s.obstacles[i].overflow; })
            .when("method", {"planes"}));
  add_stress_gauges(k);
}

}  // namespace couloir::schema_builder
