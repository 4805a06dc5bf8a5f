#pragma once
// The reference surface z = 0 of the Savage-Hutter coordinates: an incline, an arc and a run-out, uniform across the slope.
//
//   x  arc length along the surface, downslope, from the upper edge [m]
//   y  across the slope, 0 on the centre line [m]
//   n  height above the surface, along its normal [m]
//
// Grains live in the tilted frame, Cartesian: X along the incline at the upper edge, Y = y, Z normal to that incline.
// On the incline the two agree: (X, Y, Z) = (x, y, n).

#include <Eigen/Core>

namespace couloir {

struct SurfacePoint {
  double x, y, n;  // [m]
};

class ReferenceSurface {
 public:
  static ReferenceSurface flat(double length);
  static ReferenceSurface incline(double angle, double length);
  static ReferenceSurface chute(double angle, double slope, double arc, double runout);

  double length() const;             // [m] along the surface
  double angle(double x) const;      // zeta, inclination against the horizontal [rad]
  double curvature(double x) const;  // kappa = -d zeta / dx [1/m]; 1/R on the arc, 0 elsewhere
  double arc_begin() const;          // [m] along the surface
  double arc_length() const;         // [m] 0: none

  Eigen::Vector3d to_space(const SurfacePoint& p) const;     // reference coordinates -> tilted frame
  SurfacePoint to_surface(const Eigen::Vector3d& p) const;   // and back; exact inverse while n < R on the arc
  Eigen::Vector3d tangent(double x) const;                   // unit, downslope, in the tilted frame
  Eigen::Vector3d normal(double x) const;                    // unit, upward, in the tilted frame
  Eigen::Vector3d gravity_direction() const;                 // unit, in the tilted frame
  Eigen::Vector3d to_level(const Eigen::Vector3d& p) const;  // tilted frame -> X horizontal, Z up (for pictures)
  bool curved() const;                                       // has an arc

 private:
  double angle_ = 0, slope_ = 0, arc_ = 0, runout_ = 0;
};

}  // namespace couloir
