#include "coupling/calibration/angles.hpp"

#include <algorithm>
#include <cmath>

namespace couloir {

namespace {

constexpr double least_inertia = 0.01, most_inertia = 0.3, low_inertia = 0.1;  // of the line's points

struct Line {
  double at_zero = 0, slope = 0;
};

Line line_through(const std::vector<SlabPoint>& points) {
  const double n = static_cast<double>(points.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const SlabPoint& p : points) x += p.inertia / n, y += p.friction / n;
  for (const SlabPoint& p : points) xx += (p.inertia - x) * (p.inertia - x), xy += (p.inertia - x) * (p.friction - y);
  const double slope = xx > 0 ? xy / xx : 0;
  return {y - slope * x, slope};
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double mean_friction(const std::vector<SlabPoint>& points) {
  double sum = 0;
  for (const SlabPoint& p : points) sum += p.friction;
  return sum / static_cast<double>(points.size());
}

double twice_standard_error(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double n = static_cast<double>(values.size()), middle = mean(values);
  double square = 0;
  for (const double v : values) square += (v - middle) * (v - middle);
  return 2 * std::sqrt(square / (n - 1) / n);
}

SlabSpec slab(const SlabPlan& plan, const PackingSpec& stock, const TriedGrains& g, double depth, double block, long seed) {
  const double d = stock.diameter;
  SlabSpec s;
  s.stock = stock;
  s.stock.length = plan.length * d;
  s.stock.width = plan.width * d;
  s.stock.depth = block * d;
  s.stock.seed = seed;
  s.depth = depth * d;
  s.friction = g.friction;
  s.rolling_friction = g.rolling_friction;
  s.base_friction = g.base_friction;
  s.base_rolling_friction = g.base_rolling_friction;
  s.window = plan.window * std::sqrt(d / slab_gravity);
  return s;
}

}  // namespace

SlabPlan SlabPlan::full(int replicates) {
  SlabPlan plan;
  for (int k = 0; k < replicates; ++k) plan.seeds.push_back(20011 + 10007L * k);
  return plan;
}

SlabPlan SlabPlan::quick(int replicates) {
  SlabPlan plan = full(replicates);
  plan.length = 8;
  plan.delta_depths = {4, 6};
  plan.delta_speeds = {5};
  plan.delta_settling = 6;
  plan.delta_duration = 10;
  plan.phi_depth = 6;
  plan.phi_deep = 0;
  plan.phi_inertias = {0.04};
  plan.phi_settling = 4;
  plan.phi_duration = 12;
  return plan;
}

std::vector<SlabSpec> delta_slabs(const SlabPlan& plan, const PackingSpec& stock, const TriedGrains& g, double tan_delta) {
  const double d = stock.diameter, time = std::sqrt(d / slab_gravity), velocity = std::sqrt(d * slab_gravity);
  std::vector<SlabSpec> slabs;
  for (const long seed : plan.seeds) {
    for (const double depth : plan.delta_depths) {
      for (const double speed : plan.delta_speeds) {
        SlabSpec s = slab(plan, stock, g, depth, std::ranges::max(plan.delta_depths), seed);
        s.base = SlabBase::flat;
        s.slope = std::atan(0.95 * tan_delta);
        s.speed = speed * velocity;
        s.settling = plan.delta_settling * time;
        s.duration = plan.delta_duration * time;
        slabs.push_back(s);
      }
    }
  }
  return slabs;
}

DeltaReading read_delta(const SlabPlan& plan, const std::vector<SlabCurve>& curves) {
  DeltaReading out;
  std::vector<double> replicates, all, shallow, deep, slow, fast;
  std::size_t k = 0;
  for (const long seed : plan.seeds) {
    std::vector<double> of_seed;
    for (const double depth : plan.delta_depths) {
      for (const double speed : plan.delta_speeds) {
        DeltaRow row{depth, speed, seed, 0, 0};
        const std::vector<SlabPoint>& points = curves.at(k++).points;
        for (const SlabPoint& p : points) {
          row.friction += p.friction / static_cast<double>(points.size());
          row.slip += p.slip / static_cast<double>(points.size());
        }
        of_seed.push_back(row.friction);
        if (depth == plan.delta_depths.front()) shallow.push_back(row.friction);
        if (depth == plan.delta_depths.back()) deep.push_back(row.friction);
        if (speed == plan.delta_speeds.front()) slow.push_back(row.friction);
        if (speed == plan.delta_speeds.back()) fast.push_back(row.friction);
        out.rows.push_back(row);
      }
    }
    replicates.push_back(mean(of_seed));
  }
  out.friction = mean(replicates);
  out.uncertainty = twice_standard_error(replicates);
  out.depth_change = mean(deep) - mean(shallow);
  out.speed_change = mean(fast) - mean(slow);
  return out;
}

std::vector<SlabSpec> phi_slabs(const SlabPlan& plan, const PackingSpec& stock, const TriedGrains& g, double tan_incline,
                                double depth) {
  const double d = stock.diameter, time = std::sqrt(d / slab_gravity), velocity = std::sqrt(d * slab_gravity);
  const double longer = depth / plan.phi_depth;
  std::vector<SlabSpec> slabs;
  for (const long seed : plan.seeds) {
    for (const double inertia : plan.phi_inertias) {
      SlabSpec s = slab(plan, stock, g, depth, depth, seed);
      s.base = SlabBase::rough;
      s.base_friction = s.base_rolling_friction = 0;  // there is no flat base
      s.slope = std::atan(tan_incline);
      s.speed = inertia * 0.4 * std::pow(depth, 1.5) * std::sqrt(0.57 * std::cos(s.slope)) * velocity;
      s.settling = plan.phi_settling * longer * time;
      s.duration = plan.phi_duration * longer * time;
      s.window *= longer;
      slabs.push_back(s);
    }
  }
  return slabs;
}

PhiReading read_phi(const SlabPlan& plan, const std::vector<SlabCurve>& curves) {
  PhiReading out;
  std::vector<SlabPoint> all;
  std::vector<double> replicates, means;
  std::size_t k = 0;
  for (std::size_t r = 0; r < plan.seeds.size(); ++r) {
    std::vector<SlabPoint> own;
    for (std::size_t slab = 0; slab < plan.phi_inertias.size(); ++slab) {
      for (const SlabPoint& p : curves.at(k++).points) {
        out.points.push_back({static_cast<double>(r), p.inertia, p.friction});
        if (p.inertia >= least_inertia && p.inertia <= most_inertia) own.push_back(p);
      }
    }
    all.insert(all.end(), own.begin(), own.end());
    if (own.size() > 2) replicates.push_back(line_through(own).at_zero);
    if (!own.empty()) means.push_back(mean_friction(own));
  }
  std::vector<SlabPoint> every;  // where all rests, or runs away
  for (const SlabCurve& c : curves) every.insert(every.end(), c.points.begin(), c.points.end());
  out.mean = mean_friction(all.empty() ? every : all);
  out.low = std::ranges::any_of(all, [](const SlabPoint& p) { return p.inertia < low_inertia; });
  out.low = out.low && replicates.size() == plan.seeds.size();
  const Line line = out.low ? line_through(all) : Line{out.mean, 0};
  out.friction = line.at_zero;
  out.slope = line.slope;
  out.uncertainty = twice_standard_error(out.low ? replicates : means);
  return out;
}

}  // namespace couloir
