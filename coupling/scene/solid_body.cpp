#include "coupling/scene/solid_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace couloir {
namespace {

constexpr double near = 1e-12;      // share of the body's size within which a place counts as on an edge
constexpr int lines = 512;          // along the slope, on which the body is looked at from above
constexpr double high_share = 0.9;  // of the height, for the crest
constexpr double level = 0.01;      // of the height, within which a crest is flat

BodyPoint between(const BodyPoint& a, const BodyPoint& b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

double distance2(const BodyPoint& a, const BodyPoint& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
}

// [m2] of its shadow on the bed; positive where it looks up.
double plan(const BodyTriangle& t) {
  return 0.5 * ((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1]));
}

// Where an edge meets the bed: the same bits from both of its triangles.
BodyPoint on_bed(BodyPoint a, BodyPoint b) {
  if (b < a) std::swap(a, b);
  const double s = a[2] / (a[2] - b[2]);
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), 0};
}

void add_above_bed(const BodyTriangle& t, std::vector<BodyTriangle>& out) {
  std::vector<BodyPoint> polygon;
  for (int k = 0; k < 3; ++k) {
    const BodyPoint &a = t[k], &b = t[(k + 1) % 3];
    if (a[2] >= 0) polygon.push_back(a);
    if ((a[2] < 0 && b[2] > 0) || (a[2] > 0 && b[2] < 0)) polygon.push_back(on_bed(a, b));
  }
  for (std::size_t k = 2; k < polygon.size(); ++k) out.push_back({polygon[0], polygon[k - 1], polygon[k]});
}

bool flat_on_bed(const BodyTriangle& t) {
  return t[0][2] <= 0 && t[1][2] <= 0 && t[2][2] <= 0;
}

}  // namespace

std::vector<BodyTriangle> cut_to_size(const std::vector<BodyTriangle>& triangles, double size) {
  std::vector<BodyTriangle> out, left(triangles.rbegin(), triangles.rend());
  const double most = size * size * (1 + 1e-9);
  while (!left.empty()) {
    const BodyTriangle t = left.back();
    left.pop_back();
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (distance2(t[k], t[(k + 1) % 3]) > distance2(t[longest], t[(longest + 1) % 3])) longest = k;
    const BodyPoint &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
    if (distance2(a, b) <= most) {
      out.push_back(t);
      continue;
    }
    const BodyPoint m = between(a, b);
    left.push_back({m, b, c});
    left.push_back({a, m, c});
  }
  return out;
}

double smallest_angle(const std::vector<BodyTriangle>& triangles) {
  double least = std::numeric_limits<double>::infinity();
  for (const BodyTriangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const BodyPoint &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3];
      const double p[] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, q[] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      const double n = std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
      least = std::min(least, std::atan2(n, p[0] * q[0] + p[1] * q[1] + p[2] * q[2]));
    }
  }
  return least;
}

SolidBody::SolidBody(const TriangleMesh& mesh, double rotation) {
  std::vector<BodyPoint> points = mesh.vertices;
  if (rotation != 0) {
    const double c = std::cos(rotation), s = std::sin(rotation);
    for (BodyPoint& p : points) p = {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
  }
  double size = 0;
  lowest_ = std::numeric_limits<double>::infinity();
  for (const BodyPoint& p : points) {
    lowest_ = std::min(lowest_, p[2]);
    for (int k = 0; k < 3; ++k) size = std::max(size, std::abs(p[k] - points[0][k]));
  }
  // A base that is at 0 but for round-off is at 0.
  for (BodyPoint& p : points)
    if (std::abs(p[2]) <= 1e-7 * size) p[2] = 0;

  std::vector<BodyTriangle> above;
  for (const auto& f : mesh.faces) add_above_bed({points[f[0]], points[f[1]], points[f[2]]}, above);
  double x0 = std::numeric_limits<double>::infinity(), x1 = -x0, y0 = x0, y1 = -x0;
  for (const BodyTriangle& t : above) {
    if (flat_on_bed(t)) continue;
    for (const BodyPoint& p : t) {
      x0 = std::min(x0, p[0]), x1 = std::max(x1, p[0]), y0 = std::min(y0, p[1]), y1 = std::max(y1, p[1]);
      height_ = std::max(height_, p[2]);
    }
  }
  if (height_ <= 0) return;
  length_ = x1 - x0, width_ = y1 - y0;
  double upward = 0;
  for (BodyTriangle t : above) {
    if (flat_on_bed(t)) continue;
    for (BodyPoint& p : t) p = {p[0] - x0, p[1] - 0.5 * (y0 + y1), p[2]};
    upward += std::max(0.0, plan(t));
    base_area_ += plan(t);  // of a closed surface nothing would be left but for what stands on the bed
    triangles_.push_back(t);
  }
  sort_into_bins();
  measure_plan(upward);
  find_crest();
}

void SolidBody::sort_into_bins() {
  const int n = std::clamp(int(std::sqrt(double(triangles_.size()))), 1, 256);
  nx_ = ny_ = n;
  bins_.assign(std::size_t(nx_) * ny_, {});
  const auto bin = [](double at, double from, double extent, int count) {
    return std::clamp(int(std::floor((at - from) / extent * count)), 0, count - 1);
  };
  for (int k = 0; k < int(triangles_.size()); ++k) {
    const BodyTriangle& t = triangles_[k];
    if (!(plan(t) > 0)) continue;
    const auto [xl, xh] = std::minmax({t[0][0], t[1][0], t[2][0]});
    const auto [yl, yh] = std::minmax({t[0][1], t[1][1], t[2][1]});
    const double room = 1e-9 * (length_ + width_);
    for (int j = bin(yl - room, -width_ / 2, width_, ny_); j <= bin(yh + room, -width_ / 2, width_, ny_); ++j)
      for (int i = bin(xl - room, 0, length_, nx_); i <= bin(xh + room, 0, length_, nx_); ++i)
        bins_[std::size_t(j) * nx_ + i].push_back(k);
  }
}

double SolidBody::top(double x, double y) const {
  const double room = near * (length_ + width_);
  if (x < -room || x > length_ + room || std::abs(y) > width_ / 2 + room || bins_.empty()) return 0;
  const int i = std::clamp(int(x / length_ * nx_), 0, nx_ - 1), j = std::clamp(int((y / width_ + 0.5) * ny_), 0, ny_ - 1);
  double highest = 0;
  for (const int k : bins_[std::size_t(j) * nx_ + i]) {
    const BodyTriangle& t = triangles_[k];
    const double area = plan(t);
    // Shares of the corners b and c, by the areas of the triangles that the place makes with the opposite edges.
    const BodyPoint p{x, y, 0};
    const double b = plan({t[0], p, t[2]}) / area, c = plan({t[0], t[1], p}) / area, edge = room * (length_ + width_) / area;
    if (b < -edge || c < -edge || b + c > 1 + edge) continue;
    highest = std::max(highest, t[0][2] + (b * (t[1][2] - t[0][2]) + c * (t[2][2] - t[0][2])));
  }
  return std::min(highest, height_);
}

// Exact where nothing hangs over; else line by line, each line's intervals put together.
void SolidBody::measure_plan(double upward) {
  double seen = 0;
  const double dy = width_ / lines;
  for (int j = 0; j < lines; ++j) {
    const double y = -width_ / 2 + (j + 0.5) * dy;
    std::vector<std::array<double, 2>> spans;
    for (const BodyTriangle& t : triangles_) {
      if (!(plan(t) > 0)) continue;
      double from = std::numeric_limits<double>::infinity(), to = -from;
      for (int k = 0; k < 3; ++k) {
        const BodyPoint &a = t[k], &b = t[(k + 1) % 3];
        if ((a[1] <= y) == (b[1] <= y)) continue;
        const double x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        from = std::min(from, x), to = std::max(to, x);
      }
      if (from < to) spans.push_back({from, to});
    }
    std::ranges::sort(spans);
    double end = -std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : spans) {
      seen += dy * std::max(0.0, to - std::max(from, end));
      end = std::max(end, to);
    }
  }
  plan_area_ = std::abs(upward - seen) < 1e-3 * upward ? upward : seen;
}

void SolidBody::find_crest() {
  crest_x_ = length_ / 2, crest_y0_ = -width_ / 2, crest_y1_ = width_ / 2;
  const double dx = length_ / lines, dy = width_ / lines;
  std::vector<double> column(lines), first(lines, length_);  // [m] of each line: where the body begins
  double crest = -1;
  for (int j = 0; j < lines; ++j) {
    const double y = -width_ / 2 + (j + 0.5) * dy;
    for (int i = 0; i < lines; ++i) column[i] = top((i + 0.5) * dx, y);
    const double most = *std::ranges::max_element(column);
    if (!(most > 0)) continue;
    first[j] = double(std::ranges::find_if(column, [](double z) { return z > 0; }) - column.begin()) * dx;
    if (most < high_share * height_) continue;
    const auto high = [&](double z) { return z >= most - level * height_; };
    const auto from = std::ranges::find_if(column, high) - column.begin();
    const auto to = column.rend() - std::find_if(column.rbegin(), column.rend(), high);
    crest = std::max(crest, 0.5 * dx * double(from + to));
  }
  if (crest < 0) return;  // a peak between the lines
  crest_x_ = crest;
  int j0 = lines, j1 = 0;
  for (int j = 0; j < lines; ++j)
    if (first[j] < crest) j0 = std::min(j0, j), j1 = j + 1;
  if (j0 < j1) crest_y0_ = -width_ / 2 + j0 * dy, crest_y1_ = j1 == lines ? width_ / 2 : -width_ / 2 + j1 * dy;
}

}  // namespace couloir
