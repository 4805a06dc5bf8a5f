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
  const double along = px - x, aside = std::abs(py - y);
  const double half = shape == Shape::tetrahedron ? width / 2 * along / length : width / 2;
  return along >= 0 && along <= length && aside <= half;
}

double ObstacleSpec::base_area() const {
  return (shape == Shape::tetrahedron ? 0.5 : 1) * length * width;
}

double ObstacleSpec::crest_x() const {
  return x + (shape == Shape::tetrahedron ? 2.0 / 3 : 0.5) * length;
}

double ObstacleSpec::crest_width() const {
  return (shape == Shape::tetrahedron ? 2.0 / 3 : 1) * width;
}

}  // namespace couloir
