#pragma once
// Where a point stands with respect to a rim face, and which way along it leads there.

#include <cmath>

#include "coupling/engine/grain_engine.hpp"

namespace couloir {

inline double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vec from_to(const Vec& a, const Vec& b) {
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}

// [m] of a point from the face's plane, along its inward normal.
inline double distance(const DriveFace& face, const Vec& point) {
  return dot(from_to(face.origin, point), face.inward);
}

struct PlaceOnFace {
  double along;   // [m] from the face's low end, measured on the bed
  Vec direction;  // unit, along the bed
  // [-] How fast a layer that slides along the bed at 1 moves there: about the arc's axis it turns as a rigid body. Where the arc
  // begins and ends it is squeezed and stretched by this.
  double pace;
};

//    foot  .  .  . centre
//     |  \ turned
//     |     \             towards `foot` the angle is 0; before it, and past the arc's other end, the edge is straight
//   --+ . . . \ . point
inline PlaceOnFace place_on(const DriveFace& face, const Vec& point) {
  const Bend& bend = face.bend;
  if (bend.length == 0) return {dot(from_to(face.origin, point), face.along), face.along, 1};
  const Vec down = from_to(bend.centre, bend.foot), arm = from_to(bend.centre, point);
  const double radius = std::sqrt(dot(down, down));
  const double ahead = dot(arm, face.along), below = dot(arm, down) / radius;
  if (ahead <= 0) return {bend.begin + ahead, face.along, 1};
  const auto direction = [&](double on, double off) {  // of the first tangent and of `down`
    Vec v;
    for (int k = 0; k < 3; ++k) v[k] = on * face.along[k] + off * down[k] / radius;
    return v;
  };
  const double turned = std::atan2(ahead, below), whole = bend.length / radius;
  if (turned < whole) {
    const double reach = std::hypot(ahead, below);
    return {bend.begin + turned * radius, direction(below / reach, -ahead / reach), reach / radius};
  }
  const double c = std::cos(whole), s = std::sin(whole);
  return {bend.begin + bend.length + c * ahead - s * below, direction(c, -s), 1};
}

}  // namespace couloir
