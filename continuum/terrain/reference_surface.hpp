#pragma once
// The reference surface z = 0 of the Savage-Hutter coordinates, uniform across the slope: straight pieces and arcs, one after
// another, as of an incline, an arc and a run-out.
//
//   x  arc length along the surface, downslope, from the upper edge [m]
//   y  across the slope, 0 on the centre line [m]
//   n  height above the surface, along its normal [m]
//
// Grains live in the tilted frame, Cartesian: X along the surface at the upper edge, Y = y, Z normal to it there.
// On a first straight piece the two agree: (X, Y, Z) = (x, y, n).

#include <Eigen/Core>
#include <vector>

namespace couloir {

struct SurfacePoint {
  double x, y, n;  // [m]
};

// A station of a profile.
struct ProfilePoint {
  double x = 0;      // [m] along the surface
  double angle = 0;  // [rad] zeta there
};

struct Arc {
  double begin = 0, length = 0;  // [m] along the surface
  double curvature = 0;          // [1/m] kappa; positive where the slope gets gentler, negative over a brink
};

class ReferenceSurface {
 public:
  static ReferenceSurface flat(double length);
  static ReferenceSurface incline(double angle, double length);
  static ReferenceSurface chute(double angle, double slope, double arc, double runout);
  // From x = 0, x rising, the angle linear between the stations: each two with different angles have an arc between them. Angles
  // lie within 90 deg of each other. Throws std::invalid_argument.
  static ReferenceSurface profile(const std::vector<ProfilePoint>&);

  double length() const;                 // [m] along the surface
  double angle(double x) const;          // zeta, inclination against the horizontal [rad]
  double curvature(double x) const;      // kappa = -d zeta / dx [1/m]; 1/R on an arc, 0 elsewhere
  const std::vector<Arc>& arcs() const;  // in their order

  Eigen::Vector3d to_space(const SurfacePoint& p) const;     // reference coordinates -> tilted frame
  SurfacePoint to_surface(const Eigen::Vector3d& p) const;   // and back; exact inverse on this side of the arcs' centres
  Eigen::Vector3d tangent(double x) const;                   // unit, downslope, in the tilted frame
  Eigen::Vector3d normal(double x) const;                    // unit, upward, in the tilted frame
  Eigen::Vector3d gravity_direction() const;                 // unit, in the tilted frame
  Eigen::Vector3d to_level(const Eigen::Vector3d& p) const;  // tilted frame -> X horizontal, Z up (for pictures)
  bool curved() const;                                       // has an arc

 private:
  // Straight, or an arc; the first goes on upslope and the last downslope as straight ones.
  struct Piece {
    double x = 0, length = 0;         // [m] where it begins
    double angle = 0, curvature = 0;  // [rad] where it begins, [1/m]
    double at_x = 0, at_z = 0;        // [m] the same place in the tilted frame
    Eigen::Vector3d along, up;        // unit tangent and normal there
  };

  void add(double length, double angle, double next_angle);
  const Piece& piece_at(double x) const;

  std::vector<Piece> pieces_;
  std::vector<Arc> arcs_;
  double length_ = 0;
};

}  // namespace couloir
