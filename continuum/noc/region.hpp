#pragma once
// The cells, or corners, that a step works on: in each row those from one to another. What lies dry beyond costs nothing.

#include <algorithm>
#include <cstdint>
#include <vector>

namespace couloir::noc {

class Region {
 public:
  Region() = default;
  Region(int nx, int ny) : nx_(nx), spans_(ny) {}

  bool empty() const { return j0_ >= j1_; }
  int j0() const { return j0_; }  // rows that hold any lie in [j0, j1)
  int j1() const { return j1_; }
  int begin(int j) const { return spans_[j].begin; }
  int end(int j) const { return std::max(spans_[j].begin, spans_[j].end); }
  bool contains(int i, int j) const { return j >= j0_ && j < j1_ && i >= spans_[j].begin && i < spans_[j].end; }
  std::int64_t count() const;

  void add(int j, int begin, int end);  // and what lies between it and the row's others
  // All within so many rows and columns. On a periodic axis a row that reaches over the side becomes whole; rows go round.
  Region grown(int by, bool periodic_x, bool periodic_y) const;
  Region corners(bool periodic_y) const;  // of these cells; rows that are periodic twins get the same

 private:
  struct Span {
    int begin = 0, end = 0;  // empty: end <= begin
  };
  int nx_ = 0, j0_ = 0, j1_ = 0;
  std::vector<Span> spans_;
};

}  // namespace couloir::noc
