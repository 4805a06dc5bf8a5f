#include "coupling/transfer/conveyor.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

Conveyor::Conveyor(const RimFace& face, int face_index, const PackingTable& table, double layer)
    : face_(&face), face_index_(face_index), table_(&table), layer_(layer), candidates_(face.segments), state_(face.segments) {
  const Packing& block = table.packing();
  const double extent = face.cells * face.cell_width;
  const double shift = face.from_anchor - std::floor(face.from_anchor / block.width) * block.width;
  for (double offset = -shift; offset < extent; offset += block.width)
    for (const auto& grain : block.grains) {
      const double along = offset + grain.y;
      if (along < 0 || along >= extent) continue;
      // In a wall it would be shot away; what it would have carried stays owed, and the others stand a little higher.
      if ((face.walls[0] && along < grain.r) || (face.walls[1] && along > extent - grain.r)) continue;
      const int segment = face.segment_of_cell(face.cell_at(along));
      candidates_[segment].push_back({block.length - grain.x, along, grain.z, grain.r});
    }
  for (auto& list : candidates_)
    std::stable_sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) { return a.x < b.x; });
}

void Conveyor::advance(int segment, double displacement, double mass, const std::vector<double>& depth, double velocity,
                       const Occupied& occupied, std::int64_t& next_id, std::vector<NewGrain>& out) {
  State& s = state_[segment];
  const auto& list = candidates_[segment];
  const double before = s.position, owed_before = s.owed;
  s.position += displacement;
  s.owed += mass;
  if (list.empty()) return;

  const double block = table_->packing().length;
  const double d = 2 * list.front().r;
  const auto [first_cell, past] = face_->cells_of_segment(segment);
  const double area = (past - first_cell) * face_->cell_width * 4 * d;  // over which a debt is spread
  const Vec& n = face_->drive.inward;

  double taken = 0;
  for (;; ++s.passed) {
    const Candidate& c = list[s.passed % list.size()];
    const double x = c.x + double(s.passed / long(list.size())) * block;
    if (x > s.position) break;
    // What was owed at the instant this grain passed, were the flow's mass spread evenly over the displacement.
    const double share = displacement > 0 ? std::clamp((x - before) / displacement, 0.0, 1.0) : 1.0;
    const double owed = owed_before + share * mass - taken;
    const double h = depth[face_->cell_at(c.along)];
    if (h <= 0 || c.z > table_->cut(table_->bulk_density() * h + owed / area)) continue;
    const double m = table_->grain_mass(c.r);
    if (owed < -4 * m) continue;  // the tail of a flow: nothing left to take

    const double distance = -layer_ + (s.position - x);
    const double z = std::max(c.z, c.r);  // no overlap with the bed from the weight of a deeper block
    const Vec p = face_->place(distance, c.along, z);
    if (occupied(segment, p, c.r)) continue;
    Vec v;
    for (int q = 0; q < 3; ++q) v[q] = velocity * n[q];
    out.push_back({next_id++, p, v, c.r, face_index_, segment});
    taken += m;
  }
  s.owed -= taken;
}

void Conveyor::go_to(int segment, double position) {
  State& s = state_[segment];
  s.position = position;
  const auto& list = candidates_[segment];
  if (list.empty()) return;
  const double block = table_->packing().length;
  const auto passed = [&](long n) { return list[n % list.size()].x + double(n / long(list.size())) * block <= position; };
  s.passed = std::max(0l, long(std::floor(position / block)) - 1) * long(list.size());
  while (passed(s.passed)) ++s.passed;
}

double Conveyor::owed() const {
  double sum = 0;
  for (const auto& s : state_) sum += s.owed;
  return sum;
}

}  // namespace couloir
