#include "coupling/calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/calibration/bracket.hpp"

namespace couloir {

namespace {

constexpr double most_friction = 1, most_rolling = 1, least_friction = 0.05;
constexpr double most_lag = 0.012;  // [-] between mu and the incline's tangent: the slab's acceleration over its weight

double degrees(double tangent) {
  return std::atan(tangent) * 180 / std::numbers::pi;
}

// What is tried has four decimals: an error of rounding would grow among grains into another result.
double rounded(double value) {
  return std::round(1e4 * value) / 1e4;
}

class Calibration {
 public:
  Calibration(const CalibrationTask& task, const std::function<std::vector<SlabCurve>(const std::vector<SlabSpec>&)>& measure,
              const std::function<void(const std::string&)>& say)
      : task_(task), measure_(measure), say_(say), tan_delta_(std::tan(task.delta)), tan_phi_(std::tan(task.phi)) {}

  CalibrationRecord run() {
    describe_task();
    find_phi();
    find_delta();
    look_deeper();
    draw_base_curve();
    return record_;
  }

 private:
  void describe_task() {
    const PackingSpec& s = task_.stock;
    CalibrationRecord& r = record_;
    r.material = task_.material;
    r.source = task_.source;
    r.contact = contact_name(s.contact, s.tangential_damping);
    r.rotation = to_string(s.rotation);
    r.diameter = s.diameter;
    r.spread = s.spread;
    r.density = s.density;
    r.restitution = s.restitution;
    r.youngs_modulus = s.youngs_modulus;
    r.poisson_ratio = s.poisson_ratio;
    if (task_.plan.seeds.size() < 2) r.notes.push_back("one replicate: how uncertain the angles are is not known, and told as 0");
    for (const long seed : task_.plan.seeds) r.seeds.push_back(static_cast<double>(seed));
    r.slab_length = task_.plan.length;
    r.slab_width = task_.plan.width;
    r.delta.asked = degrees(tan_delta_);
    r.phi.asked = degrees(tan_phi_);
  }

  bool rolls() const { return task_.stock.contact == ContactLaw::hertz && task_.stock.rotation != Rotation::blocked; }
  double tolerance(double fine) const { return task_.quick ? std::max(0.02, fine) : fine; }

  // Phi.

  // On an incline as steep as mu itself, found from what was seen: there slabs flow nearly steadily. On a gentler one their lower
  // part stops first, and what holds the slab is less than the friction that grains have when they shear.
  PhiReading on_fitting_incline(const SlabPlan& plan, const TriedGrains& g, double depth) {
    for (int tries = 0;; ++tries) {
      const std::vector<SlabCurve> curves = measure_(phi_slabs(plan, task_.stock, g, incline_, depth));
      record_.engine = curves.front().engine;
      const PhiReading reading = read_phi(plan, curves);
      const double lag = reading.mean - incline_;
      if (tries == (task_.quick ? 1 : 5) || (reading.low && std::abs(lag) < tolerance(most_lag))) return reading;
      incline_ = rounded(std::max(0.05, incline_ + 2 * lag));  // a steeper incline raises mu by about half of what it is steeper
    }
  }

  double measure_phi(const TriedGrains& g) {
    const PhiReading reading = on_fitting_incline(task_.plan, g, task_.plan.phi_depth);
    record_.phi_search.push_back({g.friction, g.rolling_friction, reading.friction});
    say_(fmt::format("grains with friction {:.3f}, rolling friction {:.3f}: phi {:.2f} +- {:.2f} deg, {:.2f} asked for",
                     g.friction, g.rolling_friction, degrees(reading.friction), degrees(reading.uncertainty), record_.phi.asked));
    const auto miss = [&](const PhiReading& r) { return std::abs(r.friction - tan_phi_); };
    if (record_.phi_search.size() == 1 || miss(reading) < miss(phi_)) {
      record_.grains = g;
      phi_ = reading;
      record_.phi_incline = degrees(incline_);
    }
    return reading.friction;
  }

  void find_phi() {
    const double near = tolerance(0.01);
    TriedGrains g;
    if (!rolls()) g.rolling_friction = g.base_rolling_friction = 0;
    const auto with_friction = [&](double friction) {
      g.friction = rounded(friction);
      return measure_phi(g);
    };
    const auto with_rolling = [&](double rolling) {
      g.rolling_friction = rounded(rolling);
      return measure_phi(g);
    };
    const double strongest = with_friction(most_friction);
    if (strongest > tan_phi_ + near) {
      search_bracket({least_friction, most_friction, 0.3, 0.6, near, 0.01, task_.quick ? 2 : 6}, tan_phi_, with_friction);
    } else if (strongest < tan_phi_ - near && rolls()) {
      const double least = g.rolling_friction;
      search_bracket({least, most_rolling, 0.4, most_rolling, near, 0.02, task_.quick ? 2 : 5}, tan_phi_, with_rolling);
    }
    const PhiReading& reading = phi_;
    record_.phi.reached = degrees(reading.friction);
    record_.phi.uncertainty = degrees(reading.uncertainty);
    record_.phi.met = reading.low && std::abs(reading.friction - tan_phi_) <= std::max(near, reading.uncertainty);
    record_.phi_slope = reading.slope;
    record_.phi_by_sine = std::asin(std::min(1.0, reading.friction)) * 180 / std::numbers::pi;
    keep_curve(task_.plan.phi_depth, reading);
    if (!reading.low)
      record_.notes.push_back("the slabs did not flow slowly: phi is the mean of what they showed, with no limit of low inertia");
    else if (!record_.phi.met)
      record_.notes.push_back(fmt::format(
          "phi of {:.1f} deg is out of reach of these grains (friction up to {:g}, rolling friction up to {:g}): the nearest is "
          "{:.1f} deg",
          record_.phi.asked, most_friction, rolls() ? most_rolling : 0, record_.phi.reached));
  }

  void keep_curve(double depth, const PhiReading& reading) {
    for (const auto& [replicate, inertia, friction] : reading.points)
      record_.phi_slabs.push_back({depth, replicate, inertia, friction});
  }

  // One replicate: whether the depth counts.
  void look_deeper() {
    const double depth = task_.plan.phi_deep;
    if (depth <= 0) return;
    SlabPlan plan = task_.plan;
    plan.seeds.resize(1);
    const PhiReading reading = on_fitting_incline(plan, record_.grains, depth);
    keep_curve(depth, reading);
    record_.phi_deep = degrees(reading.friction);
    say_(fmt::format("a slab of {:g} d: phi {:.2f} deg", depth, record_.phi_deep));
    const double change = record_.phi_deep - record_.phi.reached;
    if (std::abs(change) > 1)
      record_.notes.push_back(
          fmt::format("phi of a slab of {:g} d differs by {:+.1f} deg from that of {:g} d", depth, change, task_.plan.phi_depth));
  }

  // Delta.

  DeltaReading measure_delta(const TriedGrains& g) {
    const DeltaReading reading = read_delta(task_.plan, measure_(delta_slabs(task_.plan, task_.stock, g, tan_delta_)));
    record_.delta_search.push_back({g.base_friction, g.base_rolling_friction, reading.friction});
    say_(fmt::format("base friction {:.4f}, base rolling friction {:.3f}: delta {:.2f} +- {:.2f} deg, {:.2f} asked for",
                     g.base_friction, g.base_rolling_friction, degrees(reading.friction), degrees(reading.uncertainty),
                     record_.delta.asked));
    return reading;
  }

  bool search_delta(TriedGrains g) {
    const double near = tolerance(0.003);
    const auto with_base = [&](double base) {
      g.base_friction = rounded(base);
      const DeltaReading reading = measure_delta(g);
      if (!found_ || std::abs(reading.friction - tan_delta_) < std::abs(delta_.friction - tan_delta_)) {
        found_ = true;
        delta_ = reading;
        record_.grains = g;
      }
      return reading.friction;
    };
    search_bracket(
        {least_friction, most_friction, std::min(tan_delta_, 0.9), std::min(1.2 * tan_delta_, most_friction), near, 0.002, 5},
        tan_delta_, with_base);
    return std::abs(delta_.friction - tan_delta_) <= std::max(near, delta_.uncertainty);
  }

  void find_delta() {
    bool met = search_delta(record_.grains);
    if (!met && rolls() && record_.grains.rolling_friction > record_.grains.base_rolling_friction) {
      TriedGrains g = record_.grains;
      g.base_rolling_friction = g.rolling_friction;
      met = search_delta(g);
    }
    CalibrationRecord& r = record_;
    r.delta.reached = degrees(delta_.friction);
    r.delta.uncertainty = degrees(delta_.uncertainty);
    r.delta.met = met;
    r.delta_depth_change = degrees(delta_.friction + delta_.depth_change) - r.delta.reached;
    r.delta_speed_change = degrees(delta_.friction + delta_.speed_change) - r.delta.reached;
    for (const DeltaRow& row : delta_.rows)
      r.delta_slabs.push_back({row.depth, row.speed, static_cast<double>(row.seed), row.friction, row.slip});
    if (!met)
      r.notes.push_back(fmt::format(
          "delta of {:.1f} deg is out of reach: the nearest is {:.2f} deg; grains roll on the base, or the slab shears within",
          r.delta.asked, r.delta.reached));
    if (std::max(std::abs(r.delta_depth_change), std::abs(r.delta_speed_change)) > 0.5)
      r.notes.push_back(
          fmt::format("no Coulomb law at the base: delta changes by {:+.2f} deg with depth and {:+.2f} deg with speed",
                      r.delta_depth_change, r.delta_speed_change));
  }

  // What delta would be at other base frictions: of these grains, and of the default ones. One replicate.
  void draw_base_curve() {
    if (task_.quick) return;
    SlabPlan plan = task_.plan;
    plan.seeds.resize(1);
    plan.delta_depths = {plan.delta_depths.back()};
    plan.delta_speeds = {plan.delta_speeds.front()};
    TriedGrains usual;
    if (!rolls()) usual.rolling_friction = usual.base_rolling_friction = 0;
    for (const TriedGrains& grains : {record_.grains, usual}) {
      std::vector<SlabSpec> slabs;
      const std::vector<double> frictions = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0};
      for (const double base : frictions) {
        TriedGrains g = grains;
        g.base_friction = base;
        slabs.push_back(delta_slabs(plan, task_.stock, g, std::min(base, tan_delta_)).front());
      }
      const std::vector<SlabCurve> curves = measure_(slabs);
      for (std::size_t k = 0; k < curves.size(); ++k)
        record_.base_curve.push_back(
            {grains.friction, grains.rolling_friction, frictions[k], read_delta(plan, {curves[k]}).friction});
    }
  }

  const CalibrationTask& task_;
  const std::function<std::vector<SlabCurve>(const std::vector<SlabSpec>&)>& measure_;
  const std::function<void(const std::string&)>& say_;
  const double tan_delta_, tan_phi_;
  CalibrationRecord record_;
  double incline_ = rounded(std::min(tan_phi_, 0.6));  // [-] tangent, of the rough base
  PhiReading phi_;
  DeltaReading delta_;
  bool found_ = false;
};

}  // namespace

CalibrationRecord calibrate(const CalibrationTask& task,
                            const std::function<std::vector<SlabCurve>(const std::vector<SlabSpec>&)>& measure,
                            const std::function<void(const std::string&)>& say) {
  return Calibration(task, measure, say).run();
}

}  // namespace couloir
