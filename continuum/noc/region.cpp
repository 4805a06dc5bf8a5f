#include "continuum/noc/region.hpp"

namespace couloir::noc {

std::int64_t Region::count() const {
  std::int64_t sum = 0;
  for (int j = j0_; j < j1_; ++j) sum += end(j) - begin(j);
  return sum;
}

void Region::add(int j, int begin, int end) {
  if (begin >= end) return;
  Span& s = spans_[j];
  s = s.begin < s.end ? Span{std::min(s.begin, begin), std::max(s.end, end)} : Span{begin, end};
  const bool first = empty();
  j0_ = first ? j : std::min(j0_, j), j1_ = first ? j + 1 : std::max(j1_, j + 1);
}

Region Region::grown(int by, bool periodic_x, bool periodic_y) const {
  const int ny = static_cast<int>(spans_.size());
  Region out(nx_, ny);
  for (int j = j0_; j < j1_; ++j) {
    if (spans_[j].begin >= spans_[j].end) continue;
    const int low = spans_[j].begin - by, high = spans_[j].end + by;
    const bool whole = periodic_x && (low < 0 || high > nx_);
    for (int n = j - by; n <= j + by; ++n) {
      if (!periodic_y && (n < 0 || n >= ny)) continue;
      out.add(((n % ny) + ny) % ny, whole ? 0 : std::max(low, 0), whole ? nx_ : std::min(high, nx_));
    }
  }
  return out;
}

Region Region::corners(bool periodic_y) const {
  const int ny = static_cast<int>(spans_.size());
  Region out(nx_ + 1, ny + 1);
  for (int j = j0_; j < j1_; ++j) {
    for (int n : {j, j + 1}) out.add(n, spans_[j].begin, spans_[j].end + (spans_[j].begin < spans_[j].end ? 1 : 0));
  }
  if (periodic_y) {
    const Span low = out.spans_[0], high = out.spans_[ny];
    out.add(0, high.begin, high.end), out.add(ny, low.begin, low.end);
  }
  return out;
}

}  // namespace couloir::noc
