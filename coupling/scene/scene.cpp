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
