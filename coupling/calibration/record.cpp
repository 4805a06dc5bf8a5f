#include "coupling/calibration/record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "coupling/scene/document.hpp"
#include "coupling/scene/scene_error.hpp"

namespace couloir {

namespace {

constexpr const char* format = "1";

// Every entry of a record, once: `each(key, what, value)` for both directions.
template <class Record, class Each>
void entries(Record& r, Each&& each) {
  each("material", "", r.material);
  each("source", "of the angles asked for", r.source);
  each("engine", "", r.engine);
  each("contact", "", r.contact);
  each("rotation", "", r.rotation);
  each("diameter", "[m]", r.diameter);
  each("spread", "of the radii", r.spread);
  each("grain_density", "[kg/m3]", r.density);
  each("restitution", "", r.restitution);
  each("youngs_modulus", "[Pa]", r.youngs_modulus);
  each("poisson_ratio", "", r.poisson_ratio);
  each("seeds", "of the replicates", r.seeds);
  each("slab_length", "[d]", r.slab_length);
  each("slab_width", "[d]", r.slab_width);
  each("friction", "found", r.grains.friction);
  each("rolling_friction", "found", r.grains.rolling_friction);
  each("base_friction", "found", r.grains.base_friction);
  each("base_rolling_friction", "found", r.grains.base_rolling_friction);
  each("delta_asked", "[deg]", r.delta.asked);
  each("delta_reached", "[deg]", r.delta.reached);
  each("delta_uncertainty", "[deg] twice the standard error of the replicates", r.delta.uncertainty);
  each("delta_met", "", r.delta.met);
  each("delta_depth_change", "[deg] deepest less shallowest slab", r.delta_depth_change);
  each("delta_speed_change", "[deg] fastest less slowest slab", r.delta_speed_change);
  each("phi_asked", "[deg]", r.phi.asked);
  each("phi_reached", "[deg] arctan of mu as I goes to 0", r.phi.reached);
  each("phi_uncertainty", "[deg] twice the standard error of the replicates", r.phi.uncertainty);
  each("phi_met", "", r.phi.met);
  each("phi_incline", "[deg] of the rough base", r.phi_incline);
  each("phi_slope", "d mu / d I", r.phi_slope);
  each("phi_by_sine", "[deg] arcsin of the same", r.phi_by_sine);
  each("phi_deep", "[deg] of the deeper slab; 0: not looked at", r.phi_deep);
  each("notes", "", r.notes);
  each("phi_search", "friction, rolling friction, tan(phi)", r.phi_search);
  each("delta_search", "base friction, base rolling friction, tan(delta)", r.delta_search);
  each("delta_slabs", "depth [d], speed [sqrt(g d)], seed, mu, slip of the lowest layer", r.delta_slabs);
  each("phi_slabs", "depth [d], replicate, I, mu", r.phi_slabs);
  each("base_curve", "friction and rolling friction of the grains, base friction, mu", r.base_curve);
}

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
  return out + "'";
}

struct Writer {
  std::string out;
  void line(const char* key, const char* what, const std::string& value) {
    out += fmt::format("{}:{}{}{}\n", key, value.empty() ? "" : " ", value, *what ? fmt::format("  # {}", what) : "");
  }
  void operator()(const char* key, const char* what, const std::string& value) { line(key, what, quoted(value)); }
  void operator()(const char* key, const char* what, double value) { line(key, what, number(value)); }
  void operator()(const char* key, const char* what, bool value) { line(key, what, value ? "true" : "false"); }
  void operator()(const char* key, const char* what, const std::vector<double>& values) {
    std::vector<std::string> items;
    for (const double v : values) items.push_back(number(v));
    line(key, what, fmt::format("[{}]", fmt::join(items, ", ")));
  }
  void operator()(const char* key, const char* what, const std::vector<std::string>& values) {
    line(key, what, values.empty() ? "[]" : "");
    for (const std::string& v : values) out += "  - " + quoted(v) + "\n";
  }
  template <std::size_t n>
  void operator()(const char* key, const char* what, const std::vector<std::array<double, n>>& rows) {
    line(key, what, rows.empty() ? "[]" : "");
    for (const auto& row : rows) {
      std::vector<std::string> items;
      for (const double v : row) items.push_back(number(v));
      out += fmt::format("  - [{}]\n", fmt::join(items, ", "));
    }
  }
};

struct Reader {
  const Node& document;

  const Node& at(const char* key, Node::Kind kind) const {
    const Node* node = document.find(key);
    if (!node) throw SceneError(fmt::format("{}: this calibration record lacks '{}'; calibrate again", document.place, key));
    if (node->kind != kind) throw SceneError(fmt::format("{}: {} is {}; calibrate again", node->place, key, describe(*node)));
    return *node;
  }
  static double number_of(const Node& node) {
    double value = 0;
    const char* end = node.text.data() + node.text.size();
    if (node.kind != Node::Kind::text || std::from_chars(node.text.data(), end, value).ptr != end)
      throw SceneError(fmt::format("{}: {} is no number; calibrate again", node.place, describe(node)));
    return value;
  }
  void operator()(const char* key, const char*, std::string& value) const { value = at(key, Node::Kind::text).text; }
  void operator()(const char* key, const char*, double& value) const { value = number_of(at(key, Node::Kind::text)); }
  void operator()(const char* key, const char*, bool& value) const { value = at(key, Node::Kind::text).text == "true"; }
  void operator()(const char* key, const char*, std::vector<double>& values) const {
    for (const Node& item : at(key, Node::Kind::list).items) values.push_back(number_of(item));
  }
  void operator()(const char* key, const char*, std::vector<std::string>& values) const {
    for (const Node& item : at(key, Node::Kind::list).items) values.push_back(item.text);
  }
  template <std::size_t n>
  void operator()(const char* key, const char*, std::vector<std::array<double, n>>& rows) const {
    for (const Node& item : at(key, Node::Kind::list).items) {
      if (item.items.size() != n)
        throw SceneError(fmt::format("{}: a row of {} has {} numbers; calibrate again", item.place, key, n));
      std::array<double, n> row{};
      for (std::size_t k = 0; k < n; ++k) row[k] = number_of(item.items[k]);
      rows.push_back(row);
    }
  }
};

}  // namespace

std::string write_calibration(const CalibrationRecord& record) {
  Writer writer;
  writer.out = fmt::format("# Made by couloir calibrate; docs/calibration.md says how.\ncalibration: {}\n", format);
  entries(record, writer);
  return writer.out;
}

CalibrationRecord read_calibration(const std::string& text, const std::string& name) {
  const Node document = parse_document(text, name);
  const Node* version = document.find("calibration");
  if (!version || version->text != format)
    throw SceneError(fmt::format("{}: this is no calibration record that this program reads ('calibration: {}')", name, format));
  CalibrationRecord record;
  entries(record, Reader{document});
  return record;
}

}  // namespace couloir
