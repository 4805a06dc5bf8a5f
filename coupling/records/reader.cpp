#include "coupling/records/reader.hpp"

#include <fmt/core.h>

#include <cstring>

#include "coupling/records/columns.hpp"

namespace couloir {
namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

std::string frame_path(long index) {
  return fmt::format("frames/{:06d}", index);
}

void read_blocks(hid_t group, BlocksView& blocks) {
  const auto column = [&](const char* name, int BlockPlace::*member) {
    const std::vector<std::int64_t> all = h5::integers(group, name);
    blocks.places.resize(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) blocks.places[k].*member = static_cast<int>(all[k]);
  };
  column("level", &BlockPlace::level);
  column("i0", &BlockPlace::i0);
  column("j0", &BlockPlace::j0);
  column("nx", &BlockPlace::nx);
  column("ny", &BlockPlace::ny);
  blocks.h = h5::numbers(group, "h");
  blocks.hu = h5::numbers(group, "hu");
  blocks.hv = h5::numbers(group, "hv");
}

}  // namespace

bool Frame::operator==(const Frame& o) const {
  const Grains &a = grains, &b = o.grains;
  return std::memcmp(&time, &o.time, sizeof time) == 0 && same_bits(h, o.h) && same_bits(hu, o.hu) && same_bits(hv, o.hv) &&
         blocks.places == o.blocks.places && same_bits(blocks.h, o.blocks.h) && same_bits(blocks.hu, o.blocks.hu) &&
         same_bits(blocks.hv, o.blocks.hv) && same_bits(a.id, b.id) && same_bits(a.x, b.x) && same_bits(a.y, b.y) &&
         same_bits(a.z, b.z) && same_bits(a.vx, b.vx) && same_bits(a.vy, b.vy) && same_bits(a.vz, b.vz) &&
         same_bits(a.radius, b.radius) && same_bits(a.driven, b.driven);
}

RecordsReader::RecordsReader(const std::string& path) : file_(h5::open_file(path)) {
  if (text("format") != "couloir records") throw RecordError(path + " is not a record of couloir");
}

std::string RecordsReader::text(const std::string& attribute) const {
  return h5::text_attribute(file_, attribute);
}
double RecordsReader::number(const std::string& attribute) const {
  return h5::number_attribute(file_, attribute);
}
bool RecordsReader::has(const std::string& attribute) const {
  return h5::has_attribute(file_, attribute);
}

bool RecordsReader::holds(const std::string& group) const {
  return h5::exists(file_, group);
}

Grid RecordsReader::grid() const {
  Grid grid;
  const h5::Handle group = h5::open_group(file_, "grid");
  if (!h5::exists(group, "x")) return grid;
  const std::vector<double> x = h5::numbers(group, "x"), y = h5::numbers(group, "y");
  grid.nx = int(x.size());
  grid.ny = int(y.size());
  // A single row or column has no spacing of its own: the other direction's stands in for it.
  const double dx = grid.nx > 1 ? (x.back() - x.front()) / (grid.nx - 1) : 0;
  const double dy = grid.ny > 1 ? (y.back() - y.front()) / (grid.ny - 1) : 0;
  grid.dx = dx > 0 ? dx : dy;
  grid.dy = dy > 0 ? dy : dx;
  grid.x0 = x.front() - grid.dx / 2;
  grid.y0 = y.front() - grid.dy / 2;
  return grid;
}

std::vector<double> RecordsReader::bed() const {
  return h5::numbers(file_, "grid/bed");
}

std::vector<long> RecordsReader::frames() const {
  const h5::Handle group = h5::open_group(file_, "frames");
  std::vector<long> indices;
  for (const std::string& name : h5::children(group)) indices.push_back(std::stol(name));
  return indices;
}

Frame RecordsReader::frame(long index) const {
  Frame out;
  const h5::Handle group = h5::open_group(file_, frame_path(index));
  out.time = h5::numbers(group, "time").at(0);
  if (text("mode") != "grains" || h5::exists(group, "h")) {
    out.h = h5::numbers(group, "h");
    out.hu = h5::numbers(group, "hu");
    out.hv = h5::numbers(group, "hv");
  }
  if (h5::exists(group, "blocks")) read_blocks(h5::open_group(group, "blocks"), out.blocks);
  if (!h5::exists(group, "grains")) return out;
  const h5::Handle set = h5::open_group(group, "grains");
  Grains& g = out.grains;
  g.id = h5::integers(set, "id");
  for (const auto& [name, column] :
       {std::pair{"x", &g.x}, {"y", &g.y}, {"z", &g.z}, {"vx", &g.vx}, {"vy", &g.vy}, {"vz", &g.vz}, {"radius", &g.radius}})
    *column = h5::numbers(set, name);
  for (const std::int64_t driven : h5::integers(set, "driven")) g.driven.push_back(std::int8_t(driven));
  return out;
}

std::vector<double> RecordsReader::window(const std::string& column) const {
  return h5::numbers(file_, "windows/" + column);
}

std::vector<std::string> RecordsReader::obstacles() const {
  return h5::children(h5::open_group(file_, "forces"));
}

std::vector<double> RecordsReader::force(const std::string& obstacle, const std::string& column) const {
  return h5::numbers(file_, "forces/" + obstacle + "/" + column);
}

std::vector<std::string> RecordsReader::gauges() const {
  if (!h5::exists(file_, "gauges")) return {};  // records of version 0.1
  return h5::children(h5::open_group(file_, "gauges"));
}

std::vector<double> RecordsReader::gauge(const std::string& name, const std::string& column) const {
  return h5::numbers(file_, "gauges/" + name + "/" + column);
}

std::vector<ForceMeasure> RecordsReader::measures() const {
  std::vector<ForceMeasure> out;
  if (!h5::exists(file_, "measures")) return out;
  const h5::Handle all = h5::open_group(file_, "measures");
  for (const std::string& kind : h5::children(all)) {
    for (const std::string& of : h5::children(h5::open_group(all, kind))) out.push_back({of, kind});
  }
  return out;
}

std::vector<std::string> RecordsReader::planes() const {
  if (!h5::exists(file_, "planes")) return {};
  return h5::children(h5::open_group(file_, "planes"));
}

std::vector<double> RecordsReader::planes(const std::string& obstacle, const std::string& column) const {
  return h5::numbers(file_, "planes/" + obstacle + "/" + column);
}

std::vector<double> RecordsReader::measure(const ForceMeasure& m, const std::string& column) const {
  return h5::numbers(file_, "measures/" + m.kind + "/" + m.of + "/" + column);
}

std::vector<double> RecordsReader::force_samples(const std::string& obstacle) const {
  if (!h5::exists(file_, "force_samples")) return {};
  return h5::numbers(file_, "force_samples/" + obstacle + "/fx");
}

std::vector<std::string> RecordsReader::stress_gauges() const {
  std::vector<std::string> out;
  if (!h5::exists(file_, "stresses")) return out;
  const h5::Handle all = h5::open_group(file_, "stresses");
  for (const std::string& of : h5::children(all)) {
    for (const std::string& name : h5::children(h5::open_group(all, of))) out.push_back(of + "/" + name);
  }
  return out;
}

std::vector<double> RecordsReader::stress(const std::string& gauge, const std::string& column) const {
  return h5::numbers(file_, "stresses/" + gauge + "/" + column);
}

std::vector<Event> RecordsReader::events() const {
  const std::vector<double> times = h5::numbers(file_, "events/time");
  const std::vector<std::string> what = h5::texts(file_, "events/text");
  std::vector<Event> out;
  if (times.size() != what.size()) throw RecordError("the record's events are damaged: times and texts differ in number");
  for (std::size_t k = 0; k < times.size(); ++k) out.push_back({times[k], what[k]});
  return out;
}

}  // namespace couloir
