#include "continuum/terrain/elevation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace couloir {
namespace {

// The seed's wedge: equilateral base L, front corner (x_f, y_f), height H.
struct Wedge {
  double xf = 17, yf = 0.5, L = 4, H = 1.8;
  double r3 = std::sqrt(3.0), xb = xf + r3 * L / 2, xc = xf + L / r3;
  ElevationBody body() const { return ElevationBody::tetrahedron(3, "wedge", xf, yf, r3 * L / 2, L, H); }
};

// (4.4), (4.5) written out; inside each of the three faces.
TEST(Elevation, TetrahedronHasTheSlopesOfItsFaces) {
  const Wedge w;
  const auto z = w.body();
  for (const double y : {w.yf - 0.4, w.yf + 0.4}) {
    const double x = w.xc - 0.6, side = y < w.yf ? 1 : -1;
    EXPECT_NEAR(z.slope_x(x, y), w.r3 * w.H / w.L, 1e-12);
    EXPECT_NEAR(z.slope_y(x, y), side * 3 * w.H / w.L, 1e-12);
    EXPECT_NEAR(z.at(x, y), w.r3 * w.H / w.L * (x - w.xf) - 3 * w.H / w.L * 0.4, 1e-12);
  }
  EXPECT_NEAR(z.slope_x(w.xb - 0.2, w.yf + 0.3), -2 * w.r3 * w.H / w.L, 1e-12);
  EXPECT_EQ(z.slope_y(w.xb - 0.2, w.yf + 0.3), 0);
  EXPECT_NEAR(z.at(w.xb - 0.2, w.yf + 0.3), 0.2 * 2 * w.r3 * w.H / w.L, 1e-12);
  EXPECT_NEAR(z.at(w.xc, w.yf), w.H, 1e-12);
  for (const auto& [x, y] : {std::pair{w.xf - 0.1, w.yf}, {w.xb + 0.1, w.yf}, {w.xf + 1, w.yf + 1}, {w.xf + 1, w.yf - 1}}) {
    EXPECT_EQ(z.at(x, y), 0);
    EXPECT_EQ(z.slope_x(x, y), 0);
    EXPECT_EQ(z.slope_y(x, y), 0);
  }
}

// The lines of (4.4), (4.5) on which planes meet: half of the sum.
TEST(Elevation, TetrahedronAveragesItsEdges) {
  const Wedge w;
  const auto z = w.body();
  for (const double side : {-1.0, 1.0}) {
    const double x = w.xf + 1.5, y = w.yf + side * 1.5 / w.r3;  // base edge x -+ sqrt(3) y = x_f -+ sqrt(3) y_f
    EXPECT_NEAR(z.at(x, y), 0, 1e-12);
    EXPECT_NEAR(z.slope_x(x, y), w.r3 * w.H / (2 * w.L), 1e-12);
    EXPECT_NEAR(z.slope_y(x, y), -side * 3 * w.H / (2 * w.L), 1e-12);
    const double xr = w.xc + 0.3, yr = w.yf + side * w.r3 * 0.3;  // back ridge
    EXPECT_NEAR(z.slope_x(xr, yr), -w.r3 * w.H / (2 * w.L), 1e-12);
    EXPECT_NEAR(z.slope_y(xr, yr), -side * 3 * w.H / (2 * w.L), 1e-12);
    EXPECT_NEAR(z.slope_x(w.xb, w.yf + side), -w.r3 * w.H / w.L, 1e-12);  // back edge
    EXPECT_EQ(z.slope_y(w.xb, w.yf + side), 0);
    EXPECT_EQ(z.at(w.xb, w.yf + side * w.L / 2), 0);  // back corner
  }
  EXPECT_NEAR(z.slope_x(w.xf + 1, w.yf), w.r3 * w.H / w.L, 1e-12);  // front ridge
  EXPECT_NEAR(z.slope_y(w.xf + 1, w.yf), 0, 1e-12);
  EXPECT_NEAR(z.slope_x(w.xf, w.yf), w.r3 * w.H / (2 * w.L), 1e-12);   // front corner, in [x_f, x_b]
  EXPECT_NEAR(z.slope_x(w.xc, w.yf), -w.r3 * w.H / (2 * w.L), 1e-12);  // peak, in [x_c, x_b]
  EXPECT_NEAR(z.slope_y(w.xc, w.yf), 0, 1e-12);
}

// The seed's wall of figure 4.7: x from 160 to 171 nodes of 0.1, H = 2.4 within one node: 24 to 1.
struct Wall {
  double x0 = 16, x1 = 17.1, y0 = -2.4, y1 = 2.4, H = 2.4, dW = 0.1, dL = 0.2;
  ElevationBody body() const { return ElevationBody::cuboid(1, "wall", x0, x1, y0, y1, H, dW, dL); }
};

TEST(Elevation, CuboidHasTheSlopesOfItsFaces) {
  const Wall w;
  const auto z = w.body();
  EXPECT_NEAR(z.slope_x(16.05, 0.3), w.H / w.dW, 1e-12);
  EXPECT_EQ(z.slope_y(16.05, 0.3), 0);
  EXPECT_NEAR(z.at(16.05, 0.3), w.H / 2, 1e-12);
  EXPECT_NEAR(z.slope_x(17.05, 0.3), -w.H / w.dW, 1e-12);
  EXPECT_NEAR(z.slope_y(16.5, -2.3), w.H / w.dL, 1e-12);
  EXPECT_NEAR(z.slope_y(16.5, 2.3), -w.H / w.dL, 1e-12);
  EXPECT_EQ(z.slope_x(16.5, 2.3), 0);
  EXPECT_EQ(z.at(16.5, 0), w.H);
  EXPECT_EQ(z.slope_x(16.5, 0), 0);
  for (const auto& [x, y] : {std::pair{15.9, 0.0}, {17.2, 0.0}, {16.5, 2.5}, {16.5, -2.5}, {15.99, 2.39}}) {
    EXPECT_EQ(z.at(x, y), 0);
    EXPECT_EQ(z.slope_x(x, y), 0);
    EXPECT_EQ(z.slope_y(x, y), 0);
  }
}

TEST(Elevation, CuboidAveragesItsEdges) {
  const Wall w;
  const auto z = w.body();
  // Grid nodes, with their round-off: base and top edges of the faces.
  EXPECT_NEAR(z.slope_x(160 * 0.1, 0.3), w.H / (2 * w.dW), 1e-12);
  EXPECT_NEAR(z.slope_x(161 * 0.1, 0.3), w.H / (2 * w.dW), 1e-12);
  EXPECT_NEAR(z.slope_x(170 * 0.1, 0.3), -w.H / (2 * w.dW), 1e-12);
  EXPECT_NEAR(z.slope_x(171 * 0.1, 0.3), -w.H / (2 * w.dW), 1e-12);
  EXPECT_EQ(z.slope_x(159 * 0.1, 0.3), 0);
  EXPECT_EQ(z.slope_x(162 * 0.1, 0.3), 0);
  EXPECT_NEAR(z.slope_y(16.5, -2.4), w.H / (2 * w.dL), 1e-12);
  EXPECT_NEAR(z.slope_y(16.5, 2.2), -w.H / (2 * w.dL), 1e-12);
  // On the edge between two faces each keeps half; at the base's corner nothing is left (4.8).
  EXPECT_NEAR(z.slope_x(16.05, -2.3), w.H / (2 * w.dW), 1e-12);
  EXPECT_NEAR(z.slope_y(16.05, -2.3), w.H / (2 * w.dL), 1e-12);
  EXPECT_NEAR(z.slope_x(16.1, -2.2), w.H / (2 * w.dW), 1e-12);
  EXPECT_EQ(z.slope_x(16, -2.4), 0);
  EXPECT_EQ(z.slope_y(16, -2.4), 0);
}

// Everywhere else the slopes are what differences of z_b say.
TEST(Elevation, SlopesAreThoseOfTheHeight) {
  for (const ElevationBody& z : {Wedge{}.body(), Wall{}.body()}) {
    const double e = 1e-6;
    int inside = 0;
    for (int i = 0; i < 97; ++i) {
      for (int j = 0; j < 89; ++j) {
        const double x = z.x0() + (i - 5.31) / 83 * (z.x1() - z.x0()), y = z.y0() + (j - 4.77) / 79 * (z.y1() - z.y0());
        EXPECT_NEAR(z.slope_x(x, y), (z.at(x + e, y) - z.at(x - e, y)) / (2 * e), 1e-7);
        EXPECT_NEAR(z.slope_y(x, y), (z.at(x, y + e) - z.at(x, y - e)) / (2 * e), 1e-7);
        inside += z.at(x, y) > 0;
      }
    }
    EXPECT_GT(inside, 2000);
  }
}

TEST(Elevation, NamesItsBodiesAndIsAFunction) {
  Elevation all;
  EXPECT_TRUE(all.empty());
  EXPECT_EQ(all.at(0, 0), 0);
  all.add(Wedge{}.body());
  all.add(Wall{}.body());
  const std::function<double(double, double)> z = all;
  EXPECT_EQ(z(16.5, 0), 2.4);
  EXPECT_EQ(all.obstacle_at(16.5, 0), 1);
  EXPECT_EQ(all.obstacle_at(19, 0.5), 3);
  EXPECT_EQ(all.obstacle_at(16, 0), 1);  // the base's edge belongs to the body
  EXPECT_EQ(all.obstacle_at(15, 0), -1);
  EXPECT_NEAR(all.slope_x(16.05, 0), 24, 1e-11);
  EXPECT_EQ(all.slope_y(15, 0), 0);
}

TEST(Elevation, RefusesBodiesThatCannotBe) {
  const auto cuboid = [](double ramp) { return ElevationBody::cuboid(0, "wall", 0, 1, 0, 2, 1, ramp, 0.1); };
  EXPECT_NO_THROW(cuboid(0.5));
  EXPECT_THROW(cuboid(0.6), std::invalid_argument);
  EXPECT_THROW(cuboid(0), std::invalid_argument);
  try {
    ElevationBody::tetrahedron(0, "wedge", 0, 0, 1, 1, -2);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "The obstacle 'wedge' needs a positive height, but got -2 m; correct its size.");
  }
}

}  // namespace
}  // namespace couloir
