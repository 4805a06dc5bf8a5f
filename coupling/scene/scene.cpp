#include "coupling/scene/scene.hpp"

#include <cmath>

namespace couloir {

const char* to_string(Mode mode) {
  switch (mode) {
    case Mode::continuum:
      return "continuum";
    case Mode::coupled:
      return "coupled";
    case Mode::grains:
      return "grains";
  }
  return "?";
}

double TerrainSpec::total_length() const {
  if (kind == Kind::profile) return profile.empty() ? 0 : profile.back().x;
  return kind == Kind::chute ? slope + arc + runout : length;
}

bool TerrainSpec::level() const {
  if (kind == Kind::profile) return std::ranges::all_of(profile, [](const ProfileRow& row) { return row.angle == 0; });
  return kind == Kind::flat || angle == 0;
}

std::vector<TerrainArc> TerrainSpec::arcs() const {
  if (kind == Kind::chute && angle > 0 && arc > 0) return {{slope, arc, angle}};
  std::vector<TerrainArc> out;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const double turn = profile[k - 1].angle - profile[k].angle;
    if (turn != 0) out.push_back({profile[k - 1].x, profile[k].x - profile[k - 1].x, turn});
  }
  return out;
}

bool ObstacleSpec::covers(double px, double py) const {
  if (shape == Shape::mesh) return top(px, py) > 0;
  const double along = px - x, aside = std::abs(py - y);
  const double half = shape == Shape::tetrahedron ? width / 2 * along / length : width / 2;
  return along >= 0 && along <= length && aside <= half;
}

double ObstacleSpec::top(double px, double py) const {
  return body->top(px - x, py - y);
}

double ObstacleSpec::base_area() const {
  if (shape == Shape::mesh) return body->plan_area();
  return (shape == Shape::tetrahedron ? 0.5 : 1) * length * width;
}

double ObstacleSpec::crest_x() const {
  if (shape == Shape::mesh) return x + body->crest_x();
  return x + (shape == Shape::tetrahedron ? 2.0 / 3 : 0.5) * length;
}

double ObstacleSpec::crest_y() const {
  return shape == Shape::mesh ? y + 0.5 * (body->crest_y0() + body->crest_y1()) : y;
}

double ObstacleSpec::crest_width() const {
  if (shape == Shape::mesh) return body->crest_y1() - body->crest_y0();
  return (shape == Shape::tetrahedron ? 2.0 / 3 : 1) * width;
}

}  // namespace couloir
