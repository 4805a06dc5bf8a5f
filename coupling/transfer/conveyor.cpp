#include "coupling/transfer/conveyor.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

Conveyor::Conveyor(const RimFace& face, int face_index, const PackingTable& table, double layer)
    : face_(&face), face_index_(face_index), table_(&table), layer_(layer), state_(face.segments) {
  for (const auto& g : table.packing().grains) block_.push_back({table.packing().length - g.x, g.y, g.z, g.r});
  std::stable_sort(block_.begin(), block_.end(), [](const Candidate& a, const Candidate& b) { return a.x < b.x; });
}

void Conveyor::slide(double distance) {
  slid_ += distance;
  slid_now_ = distance;
}

void Conveyor::advance(int segment, const Pull& pull, const std::vector<double>& depth, const Occupied& occupied,
                       std::int64_t& next_id, std::vector<NewGrain>& out) {
  State& s = state_[segment];
  if (s.filled == 0) s.passed = first_after(reach(s));
  // What has slid away behind a raft that went back comes again.
  if (slid_now_ != 0)
    while (comes_at(s.passed - 1) > reach(s)) --s.passed;
  const double before = reach(s);
  s.position += pull.displacement;
  s.filled = std::min(layer_, s.filled + std::max(0.0, pull.displacement) + std::abs(slid_now_));
  if (pull.open_end && slid_now_ != 0) take_by_end(segment, pull, depth, occupied, next_id, out);
  take_by_plane(segment, before, pull, depth, occupied, next_id, out);
}

long Conveyor::first_after(double come) const {
  long n = (long(std::floor(come / table_->packing().length)) - 1) * long(block_.size());
  while (comes_at(n) <= come) ++n;
  return n;
}

double Conveyor::comes_at(long n) const {
  const long size = long(block_.size());
  const long laps = n >= 0 ? n / size : -((size - 1 - n) / size);
  return block_[n - laps * size].x + double(laps) * table_->packing().length;
}

const Conveyor::Candidate& Conveyor::grain(long n) const {
  const long size = long(block_.size());
  return block_[((n % size) + size) % size];
}

double Conveyor::first_place(const Candidate& c, double from) const {
  const double width = table_->packing().width, at = c.y - face_->from_anchor + slid_;
  return at + std::ceil((from - at) / width) * width;
}

bool Conveyor::stands_in_wall(double along, double r) const {
  return (face_->walls[0] && along < r) || (face_->walls[1] && along > face_->extent() - r);
}

NewGrain Conveyor::make(int segment, const Candidate& c, double distance, double along, const Pull& pull) const {
  const double z = std::max(c.z, c.r);  // no overlap with the bed from the weight of a deeper block
  const Vec way = face_->direction(along);
  Vec v;
  for (int q = 0; q < 3; ++q) v[q] = pull.velocity * face_->drive.inward[q] + pull.slide * way[q];
  return {0, face_->place(distance, along, z), v, c.r, face_index_, segment};
}

void Conveyor::take_by_plane(int segment, double before, const Pull& pull, const std::vector<double>& depth,
                             const Occupied& occupied, std::int64_t& next_id, std::vector<NewGrain>& out) {
  State& s = state_[segment];
  const double d = 2 * block_.front().r, come = reach(s) - before;
  const auto [low, high] = face_->reach_of_segment(segment);
  const double area = (high - low) * 4 * d;  // over which a debt is spread
  double taken = 0;
  for (;; ++s.passed) {
    const Candidate& c = grain(s.passed);
    const double x = comes_at(s.passed);
    if (x > reach(s)) break;
    // What was due at the instant this grain passed, were the flow's mass spread evenly over the way.
    const double share = come > 0 ? std::clamp((x - before) / come, 0.0, 1.0) : 1.0;
    for (double along = first_place(c, low); along < high; along += table_->packing().width) {
      // In a wall it would be shot away; what it would have carried stays owed, and the others stand a little higher.
      if (stands_in_wall(along, c.r)) continue;
      const double due = pull.due - (1 - share) * pull.mass - taken, h = depth[face_->cell_at(along)];
      if (h <= 0 || c.z > table_->cut(table_->bulk_density() * h + due / area)) continue;
      const double m = table_->grain_mass(c.r);
      if (due < -4 * m) continue;  // the tail of a flow: nothing left to take
      NewGrain g = make(segment, c, -layer_ + (s.position - x), along, pull);
      if (occupied(segment, g.position, c.r)) continue;
      g.id = next_id++;
      out.push_back(g);
      taken += m;
    }
  }
}

// Of the block's part that has passed the plane, what has slid into the segment in the last window.
void Conveyor::take_by_end(int segment, const Pull& pull, const std::vector<double>& depth, const Occupied& occupied,
                           std::int64_t& next_id, std::vector<NewGrain>& out) const {
  const State& s = state_[segment];
  const auto [low, high] = face_->reach_of_segment(segment);
  const double from = slid_now_ > 0 ? low : std::max(low, high + slid_now_);
  const double to = slid_now_ > 0 ? std::min(high, low + slid_now_) : high;
  for (long n = s.passed - 1; comes_at(n) > s.position - layer_; --n) {
    const Candidate& c = grain(n);
    const double distance = -layer_ + (s.position - comes_at(n));
    if (distance < -layer_) continue;  // the raft has gone back
    for (double along = first_place(c, from); along < to; along += table_->packing().width) {
      if (c.z > table_->cut(table_->bulk_density() * depth[face_->cell_at(along)])) continue;
      NewGrain g = make(segment, c, distance, along, pull);
      if (occupied(segment, g.position, c.r)) continue;
      g.id = next_id++;
      out.push_back(g);
    }
  }
}

void Conveyor::go_on(int segment, const Conveyor& before, int before_segment) {
  const State& was = before.state_[before_segment];
  state_[segment].position = was.position;
  state_[segment].filled = was.filled;
  state_[segment].passed = was.passed;
  slid_ = before.slid_;
  slid_now_ = before.slid_now_;
}

bool Conveyor::filling() const {
  return std::ranges::any_of(state_, [&](const State& s) { return s.filled < layer_; });
}

double Conveyor::owed() const {
  double sum = 0;
  for (const auto& s : state_) sum += s.owed;
  return sum;
}

}  // namespace couloir
