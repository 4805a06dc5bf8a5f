#pragma once
// Material in flight. A grain that leaves a zone above the flow outside is no flow yet: it goes on as a point of mass on its
// ballistic arc in the tilted frame, which is followed exactly,
//
//   p(t) = p0 + v0 t + g t^2/2,   v(t) = v0 + g t          g [m/s2] the gravity vector of the tilted frame
//
// until its centre comes down to the flow: n <= z_b + h, the height above the reference surface, bed (steps included) and depth
// of the cell of the coarsest grid that it is over.
//
//    ____      o -> v
//   |    |            `  .
//   |zone|                 `o     n
//   |____|~~~~~~~~~~~~~~~~~~~~~~  z_b + h
//
// Where it ends:
//   on the flow or the bed   its mass and its momentum along the surface become flow of that cell; the part along the normal is
//                            lost to the bed
//   against the side of a    it comes down in the cell before it, with its momentum, which the step or the wall then takes from
//   step, or a wall          the flow, as from all flow: nothing is known of how it would bounce
//   over a covered zone      likewise: the zone draws it in through its face, as it does with all that comes. A zone that has
//                            grown under a flight sends it to the nearest cell outside
//   beyond an open side      it has left the domain
// and round a periodic side it goes on. What comes down is at once where it fell: a fall down a wall takes no time.
//
// Keeps: mass and momentum along the surface, to round-off. Errors: none of its own.

#include <array>
#include <vector>

#include "continuum/solver.hpp"
#include "continuum/terrain/reference_surface.hpp"
#include "coupling/checkpoint/archive.hpp"
#include "coupling/engine/grain_engine.hpp"

namespace couloir {

struct AirborneSettings {
  enum class Edge { wall, open, periodic };
  Grid grid;
  std::array<Edge, 4> sides{};  // by SideName
  std::vector<double> bed;      // [m] above the reference surface, steps included, [j * nx + i]
  double gravity = 9.81;        // [m/s2]
  double bulk_density = 0;      // [kg/m3] of the flow
};

class Airborne {
 public:
  struct Landing {
    double mass = 0;               // [kg]
    SurfacePoint at{};             // of its centre
    int i = 0, j = 0;              // the cell that has it now
    double along = 0, across = 0;  // [m/s]
    void state(Archive& a) { a(mass, at, i, j, along, across); }
  };
  // Since the last collect(), along the surface.
  struct Booked {
    double gravity = 0;  // [N s] what gravity gave: m g sin(zeta) t; across an arc with what the turning surface makes of it
    double left = 0;     // [N s] of what left the domain
  };

  // Keeps the surface.
  Airborne(const AirborneSettings&, const ReferenceSurface&);

  // Takes the grain over where it flies: its lower edge is more than a diameter [m] above the flow below it, and no other grain
  // lies lower within two diameters of its centre, so that it is no part of an outflow. False: it does not, and nothing changes.
  bool take_off(const Grains&, std::size_t grain, double mass, double diameter, const Solver&);
  void take_off(double mass, const Vec& position, const Vec& velocity);

  // All flights go on for dt [s], over the flow as it is now; what comes down is the solver's.
  void advance(double dt, Solver&);

  double mass() const;                   // [kg] in the air
  double momentum() const;               // [N s] along the surface
  double left() const { return left_; }  // [kg] that has left the domain, since the start
  std::size_t flights() const { return flights_.size(); }
  const std::vector<Landing>& landings() const { return landings_; }  // in the last advance
  Booked collect();
  void state(Archive& a) { a(flights_, booked_, left_); }

 private:
  struct Flight {
    Vec position{}, velocity{};
    double mass = 0;
  };
  struct Place {
    enum class Kind { air, flow, zone, side } kind = Kind::air;
    int i = 0, j = 0;  // the cell; kind side: the nearest
    int side = 0;      // kind side
    SurfacePoint at{};
    double bed = 0, top = 0;  // [m] of the cell: z_b, z_b + h
  };
  Place look(const Vec&, const Solver&) const;
  bool covered(int i, int j, const Solver&) const;
  std::array<int, 2> open_cell_near(int i, int j, const Solver&) const;
  double along(const Vec& position, const Vec& velocity) const;  // [m/s]
  bool fly(Flight&, double dt, Solver&);                         // false: it has ended
  void land(const Flight&, const Place&, int i, int j, Solver&);
  Flight after(const Flight&, double t) const;

  AirborneSettings settings_;
  const ReferenceSurface* surface_;
  Vec gravity_{};
  std::vector<Flight> flights_;
  std::vector<Landing> landings_;
  Booked booked_;
  double left_ = 0;
};

}  // namespace couloir
