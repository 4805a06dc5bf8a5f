#include "coupling/transfer/airborne.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {
namespace {

Eigen::Map<const Eigen::Vector3d> eigen(const Vec& v) {
  return Eigen::Map<const Eigen::Vector3d>(v.data());
}
Vec plus(const Vec& a, double by, const Vec& b) {
  return {a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]};
}

}  // namespace

Airborne::Airborne(const AirborneSettings& settings, const ReferenceSurface& surface) : settings_(settings), surface_(&surface) {
  const Eigen::Vector3d g = settings.gravity * surface.gravity_direction();
  gravity_ = {g.x(), g.y(), g.z()};
}

bool Airborne::covered(int i, int j, const Solver& solver) const {
  for (int zone = 0; zone < solver.zones(); ++zone)
    if (solver.covered(zone).contains(i, j)) return true;
  return false;
}

// The nearest across one of its zone's sides.
std::array<int, 2> Airborne::open_cell_near(int i, int j, const Solver& solver) const {
  for (int zone = 0; zone < solver.zones(); ++zone) {
    const CellBox& b = solver.covered(zone);
    if (!b.contains(i, j)) continue;
    std::array<int, 2> best{i, j};
    int least = settings_.grid.nx + settings_.grid.ny;
    const std::array<int, 2> across[] = {{b.i0 - 1, j}, {b.i1, j}, {i, b.j0 - 1}, {i, b.j1}};
    for (const auto& [m, n] : across) {
      const int far = std::abs(m - i) + std::abs(n - j);
      if (m < 0 || n < 0 || m >= settings_.grid.nx || n >= settings_.grid.ny || far >= least) continue;
      best = {m, n}, least = far;
    }
    return best;
  }
  return {i, j};
}

Airborne::Place Airborne::look(const Vec& p, const Solver& solver) const {
  const Grid& g = settings_.grid;
  Place place;
  place.at = surface_->to_surface(eigen(p));
  place.i = std::clamp(int(std::floor((place.at.x - g.x0) / g.dx)), 0, g.nx - 1);
  place.j = std::clamp(int(std::floor((place.at.y - g.y0) / g.dy)), 0, g.ny - 1);
  const bool beyond[] = {place.at.x<g.x0, place.at.x> g.x0 + g.nx * g.dx, place.at.y<g.y0, place.at.y> g.y0 + g.ny * g.dy};
  for (int side = 0; side < 4; ++side) {
    if (!beyond[side]) continue;
    place.kind = Place::Kind::side, place.side = side;
    return place;
  }
  place.bed = settings_.bed[std::size_t(place.j) * g.nx + place.i];
  place.top = place.bed + solver.at(place.i, place.j).h;
  if (covered(place.i, place.j, solver)) {
    place.kind = Place::Kind::zone;
  } else if (place.at.n <= place.top) {
    place.kind = Place::Kind::flow;
  }
  return place;
}

double Airborne::along(const Vec& position, const Vec& velocity) const {
  return surface_->tangent(surface_->to_surface(eigen(position)).x).dot(eigen(velocity));
}

bool Airborne::take_off(const Grains& g, std::size_t k, double mass, double diameter, const Solver& solver) {
  const Vec p{g.x[k], g.y[k], g.z[k]};
  const Place place = look(p, solver);
  if (place.kind != Place::Kind::air || place.at.n - g.radius[k] <= place.top + diameter) return false;
  const Eigen::Vector3d normal = surface_->normal(place.at.x);
  for (std::size_t n = 0; n < g.size(); ++n) {
    const Eigen::Vector3d off(g.x[n] - p[0], g.y[n] - p[1], g.z[n] - p[2]);
    if (n != k && off.squaredNorm() < 4 * diameter * diameter && off.dot(normal) < 0) return false;
  }
  take_off(mass, p, {g.vx[k], g.vy[k], g.vz[k]});
  return true;
}

void Airborne::take_off(double mass, const Vec& position, const Vec& velocity) {
  flights_.push_back({position, velocity, mass});
}

void Airborne::advance(double dt, Solver& solver) {
  landings_.clear();
  std::erase_if(flights_, [&](Flight& f) { return !fly(f, dt, solver); });
}

Airborne::Flight Airborne::after(const Flight& f, double t) const {
  return {plus(plus(f.position, t, f.velocity), 0.5 * t * t, gravity_), plus(f.velocity, t, gravity_), f.mass};
}

// In parts so short that no cell is missed; where it ends within one, that instant is found to the last bit.
bool Airborne::fly(Flight& flight, double dt, Solver& solver) {
  const Grid& g = settings_.grid;
  const auto book = [&](const Flight& from, const Flight& to) {
    booked_.gravity += flight.mass * (along(to.position, to.velocity) - along(from.position, from.velocity));
  };
  Place before = look(flight.position, solver);
  Flight start = flight;  // of the arc that t counts from
  double t = 0, spent = 0;
  while (before.kind == Place::Kind::air) {
    if (spent + t >= dt) {
      book(start, flight);
      return true;
    }
    const double speed = eigen(after(start, t).velocity).norm() + settings_.gravity * dt;
    const double part = std::min(dt - spent - t, 0.25 * std::min(g.dx, g.dy) / speed);
    double low = t, high = spent + t + part >= dt ? dt - spent : t + part;
    Place here = look(after(start, high).position, solver);
    if (here.kind == Place::Kind::air) {
      t = high, before = here, flight = after(start, t);
      continue;
    }
    for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high)) {
      const Place there = look(after(start, middle).position, solver);
      if (there.kind == Place::Kind::air) {
        low = middle, before = there;
      } else {
        high = middle, here = there;
      }
    }
    flight = after(start, high);
    book(start, flight);
    if (here.kind == Place::Kind::side) {
      const AirborneSettings::Edge edge = settings_.sides[here.side];
      if (edge == AirborneSettings::Edge::open) {
        left_ += flight.mass;
        booked_.left += flight.mass * along(flight.position, flight.velocity);
        return false;
      }
      if (edge == AirborneSettings::Edge::periodic) {
        const bool x = here.side < 2;
        const double sign = here.side % 2 == 0 ? 1 : -1;
        const Eigen::Vector3d way = x ? surface_->tangent(g.x0) : Eigen::Vector3d::UnitY();
        flight.position = plus(flight.position, sign * (x ? g.nx * g.dx : g.ny * g.dy), {way.x(), way.y(), way.z()});
        spent += high, t = 0, start = flight;
        here = look(flight.position, solver);
        if (here.kind == Place::Kind::side) here.kind = Place::Kind::air;  // by a rounding, on the side itself
        before = here;
        continue;
      }
    }
    const bool against = here.kind != Place::Kind::flow || here.at.n < here.bed;
    const Place& down = against ? before : here;
    land(flight, here, down.i, down.j, solver);
    return false;
  }
  // The flow has risen to it, or a zone has grown under it.
  const auto [i, j] = open_cell_near(before.i, before.j, solver);
  land(flight, before, i, j, solver);
  return false;
}

void Airborne::land(const Flight& f, const Place& place, int i, int j, Solver& solver) {
  const double depth = f.mass / (settings_.bulk_density * settings_.grid.dx * settings_.grid.dy);
  const double u = along(f.position, f.velocity), v = f.velocity[1];
  solver.add(i, j, {depth, depth * u, depth * v});
  landings_.push_back({f.mass, place.at, i, j, u, v});
}

double Airborne::mass() const {
  double sum = 0;
  for (const Flight& f : flights_) sum += f.mass;
  return sum;
}

double Airborne::momentum() const {
  double sum = 0;
  for (const Flight& f : flights_) sum += f.mass * along(f.position, f.velocity);
  return sum;
}

Airborne::Booked Airborne::collect() {
  const Booked booked = booked_;
  booked_ = {};
  return booked;
}

}  // namespace couloir
