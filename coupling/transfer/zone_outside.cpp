// What a zone sees of the flow outside of its faces (zone.hpp).

#include <algorithm>
#include <cmath>

#include "coupling/transfer/zone.hpp"

namespace couloir {

FlowState Zone::outside(const Solver& solver, const RimFace& face, int k) const {
  const auto [i, j] = rim_.outside_cell(face, k);
  return solver.at_side(i, j, opposite(face.side));
}

void Zone::look_outside(const Solver& solver) {
  const double still = 1e-3 * std::sqrt(settings_.gravity * settings_.rim.diameter);
  for (int f = 0; f < int(rim_.faces().size()); ++f) {
    const RimFace& face = rim_.faces()[f];
    double all_h = 0, all_hn = 0, all_ha = 0;
    for (int s = 0; s < face.segments; ++s) {
      double h = 0, hn = 0, ha = 0;
      const auto [first, last] = face.cells_of_segment(s);
      for (int k = first; k < last; ++k) {
        const FlowState q = outside(solver, face, k);
        h += q.h;
        hn += face.sign() * (face.axis() == 0 ? q.hu : q.hv);
        ha += face.axis() == 0 ? q.hv : q.hu;
      }
      Segment& segment = segments_[f][s];
      segment.depth = h / (last - first);
      segment.comes = h > 0 ? hn / h : 0;
      if (segment.depth <= least_depth() && !closed_) continue;  // the last flow's velocity carries its driven grains in
      segment.along = h > 0 ? ha / h : 0;
      segment.fast_outflow = hn < -2 * h * std::sqrt(settings_.gravity * segment.depth);
      const bool before = segment.inflow;
      segment.inflow = !closed_ && std::hypot(hn, ha) > still * h && carried(face, segment, hn, ha);
      if (segment.inflow) all_h += h, all_hn += hn, all_ha += ha;
      // A raft starts with its flow: one that had to be pushed into motion would dam it up first.
      if (segment.inflow != before) {
        segment.raft = segment.rate = segment.inflow ? hn / h : 0;
        segment.held = 0;
      }
    }
    // One velocity for the face's free inflow, so that neighbouring rafts keep step and do not shear their grains into each
    // other; the depths differ, so the flow that each cell gives still does.
    if (all_h == 0) continue;
    slide_[f] = face.slides ? all_ha / all_h : 0;
    for (Segment& segment : segments_[f])
      if (segment.inflow) segment.normal = all_hn / all_h;
  }
}

// A flow that runs along a face must not find it open: what stands inside would spread. A raft goes along with it, to where it
// clearly leaves. A film presses on nothing. A face that cannot slide draws in only what is steep: its driven layer would lag
// behind.
bool Zone::carried(const RimFace& face, const Segment& segment, double normal, double along) const {
  const bool film = segment.depth < (segment.inflow ? 0.25 : 0.5) * settings_.rim.diameter;
  if (!face.slides || film) return normal > steepest_ * std::abs(along) && normal > 0;
  return normal > (segment.inflow ? leaves_ : grazes_) * std::abs(along);
}

double Zone::weight(int f, int k) const {
  return settings_.gravity * std::cos(surface_->angle(grid_.x(rim_.outside_cell(rim_.faces()[f], k).first)));
}

// What turns the flow on an arc weighs on its bed, too, and presses sidewards. The depth-averaged flow leaves that out of its
// pressure; grains have it, and would spread from under a push without it.
double Zone::push_on_grains(const Solver& solver, int f, int k, double raft) const {
  const int i = rim_.outside_cell(rim_.faces()[f], k).first;
  const FlowState q = outside(solver, rim_.faces()[f], k);
  const double u = q.h > 0 ? q.hu / q.h : 0;
  return push(solver, f, k, raft, weight(f, k) + surface_->curvature(grid_.x(i)) * u * u);
}

double Zone::push(const Solver& solver, int f, int k, double raft, double weight) const {
  const RimFace& face = rim_.faces()[f];
  const auto [i, j] = rim_.outside_cell(face, k);
  const FlowState q = outside(solver, face, k);
  if (q.h <= 0) return 0;
  const double pressure = solver.earth_pressure(i, j)[face.axis()] * weight;
  const double w = std::max(0.0, face.sign() * (face.axis() == 0 ? q.hu : q.hv) / q.h - raft);
  return q.h * w * w + 0.5 * pressure * q.h * q.h + q.h * w * (w + std::sqrt(pressure * q.h));
}

void Zone::drive_raft(const Solver& solver, int f, int s, SegmentDrive& drive) const {
  const RimFace& face = rim_.faces()[f];
  const Segment& segment = segments_[f][s];
  const auto [first, last] = face.cells_of_segment(s);
  double force = 0;
  for (int k = first; k < last; ++k) force += push_on_grains(solver, f, k, segment.raft);
  drive.push = force * face.cell_width * table_->bulk_density();
  drive.most = segment.normal;
  drive.least = fresh_ ? drive.most : std::min(drive.most, -0.25 * std::sqrt(settings_.gravity * segment.depth));
  drive.along = segment.along;
  drive.least_mass = 5 * table_->mean_mass();
}

void Zone::drive_strip(const Solver& solver, int f, int s, SegmentDrive& drive) const {
  const RimFace& face = rim_.faces()[f];
  const auto [first, last] = face.cells_of_segment(s);
  const int reach = int(rim_.buffer() / (face.axis() == 0 ? grid_.dx : grid_.dy)), outwards = -int(face.sign());
  const auto mean = [&](bool beyond) {  // over the segment's cells: where the strip stands, or just inside of the face
    FlowState sum;
    for (int k = first; k < last; ++k) {
      auto [i, j] = beyond ? rim_.outside_cell(face, k) : rim_.inside_cell(face, k);
      if (beyond) (face.axis() == 0 ? i : j) += outwards * reach;
      const FlowState q = solver.at(std::clamp(i, 0, grid_.nx - 1), std::clamp(j, 0, grid_.ny - 1));
      sum.h += q.h, sum.hu += q.hu, sum.hv += q.hv;
    }
    return sum;
  };
  const auto outward = [&](const FlowState& q) { return outwards * (face.axis() == 0 ? q.hu : q.hv); };
  const FlowState there = mean(true), here = mean(false);
  const double depth = there.h / (last - first);
  drive.exit_active = depth > 0.5 * settings_.rim.diameter && outward(there) > 0 && outward(here) > 0;
  if (!drive.exit_active) return;
  // A subcritical outflow is told by the flow beyond how fast to leave. A supercritical one has made the flow beyond: that
  // velocity alone feeds back and runs away by 1 % in a zone's length, its own alone by 2 % the other way (measured, Fr 1.66);
  // half of each does not.
  const double own = outward(there) > there.h * std::sqrt(settings_.gravity * depth) ? 0.5 : 0;
  const double u = own * here.hu / here.h + (1 - own) * there.hu / there.h;
  const double v = own * here.hv / here.h + (1 - own) * there.hv / there.h;
  const double x = grid_.x(rim_.outside_cell(face, (first + last) / 2).first);
  const Eigen::Vector3d velocity = u * surface_->tangent(x) + v * Eigen::Vector3d::UnitY();
  drive.exit_velocity = {velocity.x(), velocity.y(), velocity.z()};
}

std::vector<Zone::Look> Zone::look(const Solver& solver, const RimFace& face, int cells) const {
  const int f = int(&face - rim_.faces().data());
  std::vector<Look> out(face.cells);
  for (int k = 0; k < face.cells; ++k) {
    auto [ci, cj] = rim_.inside_cell(face, k);
    (face.axis() == 0 ? ci : cj) += int(face.sign()) * cells;
    const auto normal = [&](const FlowState& q) { return q.h > 0 ? face.sign() * (face.axis() == 0 ? q.hu : q.hv) / q.h : 0; };
    const FlowState beyond = outside(solver, face, k);
    const CellBox& box = settings_.box;
    const FlowState inside = solver.at(std::clamp(ci, box.i0, box.i1 - 1), std::clamp(cj, box.j0, box.j1 - 1));
    const double u = segments_[f][face.segment_of_cell(k)].inflow ? normal(beyond) : 0;
    out[k] = {u, normal(inside), beyond.h, beyond.h > 0 ? u / std::sqrt(settings_.gravity * beyond.h) : 0};
    if (inside.h < 0.5 * settings_.rim.diameter) out[k].inside = u;  // no grains there yet
  }
  return out;
}

bool Zone::flow_comes(const Solver& solver) {
  look_outside(solver);
  const double d = settings_.rim.diameter, least = 0.1 * std::sqrt(settings_.gravity * d);
  for (const auto& face : segments_)
    for (const Segment& segment : face)
      if (segment.comes > least && segment.depth > 0.5 * d) return true;
  return false;
}

}  // namespace couloir
