#pragma once
// A solid body of triangles that stands on the bed, in a frame of its own:
//
//   x  along the slope, from the body's upstream end [m]         z = 0 is the bed; what reaches below it is cut off
//   y  across it, from the middle of the body's width [m]
//   z  along the normal [m]

#include <array>
#include <string>
#include <vector>

namespace couloir {

using BodyPoint = std::array<double, 3>;
using BodyTriangle = std::array<BodyPoint, 3>;  // counter-clockwise seen from outside

struct TriangleMesh {
  std::vector<BodyPoint> vertices;
  std::vector<std::array<int, 3>> faces;  // numbers of vertices
};

// Corners in the very same place become one; triangles without extent go.
TriangleMesh welded(const std::vector<BodyTriangle>&);

// What keeps the mesh from being the surface of a body: "is open: ...", "has triangles ... turned ...", "is turned inside out:
// ...". Empty: it is one.
std::string flaw_of(const TriangleMesh&);

// Cut at their longest edge until no edge is longer than `size` [m]. Triangles that share an edge cut it alike.
std::vector<BodyTriangle> cut_to_size(const std::vector<BodyTriangle>&, double size);

double smallest_angle(const std::vector<BodyTriangle>&);  // [rad]

class SolidBody {
 public:
  // A mesh without flaw, turned by `rotation` [rad] about the normal, counter-clockwise seen from above.
  SolidBody(const TriangleMesh&, double rotation);

  double length() const { return length_; }  // [m] of the box around what is above the bed
  double width() const { return width_; }
  double height() const { return height_; }
  double lowest() const { return lowest_; }        // [m] z of the whole mesh's lowest point
  double base_area() const { return base_area_; }  // [m2] where it stands on the bed; 0: it does not
  double plan_area() const { return plan_area_; }  // [m2] seen from above

  // [m] z of the highest of its surfaces over (x, y), edges included; 0 beside it.
  double top(double x, double y) const;
  bool covers(double x, double y) const { return top(x, y) > 0; }  // seen from above

  // The crest: of the lines along the slope on which the body reaches 9/10 of its height, the place where it is highest; of
  // these the one farthest downstream. What has passed there, within the width of what stands upstream of it, has come over.
  double crest_x() const { return crest_x_; }
  double crest_y0() const { return crest_y0_; }
  double crest_y1() const { return crest_y1_; }

  const std::vector<BodyTriangle>& triangles() const { return triangles_; }  // above the bed, without the base

 private:
  void sort_into_bins();
  void measure_plan(double upward);
  void find_crest();

  std::vector<BodyTriangle> triangles_;
  double length_ = 0, width_ = 0, height_ = 0, lowest_ = 0, base_area_ = 0, plan_area_ = 0;
  double crest_x_ = 0, crest_y0_ = 0, crest_y1_ = 0;
  int nx_ = 1, ny_ = 1;
  std::vector<std::vector<int>> bins_;  // triangles that look up, by a raster of nx_ x ny_ over the box
};

}  // namespace couloir
