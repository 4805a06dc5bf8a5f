#include "coupling/records/xdmf.hpp"

#include <fmt/core.h>

#include <filesystem>

namespace couloir {
namespace {

constexpr const char* kTail = "    </Grid>\n  </Domain>\n</Xdmf>";

std::string head(const std::string& name) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">",
      name);
}

std::string item(const std::string& shape, const char* type, int bytes, const std::string& path) {
  return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">records.h5:{}</DataItem>",
                     shape, type, bytes, path);
}

std::string attribute(const char* name, const char* kind, const std::string& data) {
  return fmt::format("\n        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>", name, kind, data);
}

std::string begin(double time, const std::string& topology, const std::string& points) {
  return fmt::format(
      "      <Grid GridType=\"Uniform\">\n        <Time Value=\"{:.9g}\"/>\n        <Topology {}/>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>",
      time, topology, points);
}

std::string frame_path(const FrameView& view) {
  return fmt::format("/frames/{:06d}/", view.index);
}

std::string flow_grid(const FrameView& view, const Grid& grid) {
  const std::string at = frame_path(view), scalar = fmt::format("1 {} {}", grid.ny, grid.nx), vector = scalar + " 3";
  std::string text = begin(view.time, fmt::format("TopologyType=\"3DSMesh\" Dimensions=\"{}\"", scalar),
                           item(vector, "Float", 4, at + "surface"));
  text += attribute("depth", "Scalar", item(scalar, "Float", 8, at + "h"));
  text += attribute("momentum along", "Scalar", item(scalar, "Float", 8, at + "hu"));
  text += attribute("momentum across", "Scalar", item(scalar, "Float", 8, at + "hv"));
  text += attribute("velocity", "Vector", item(vector, "Float", 4, at + "velocity"));
  return text + "\n      </Grid>";
}

std::string grains_grid(const FrameView& view) {
  const std::string at = frame_path(view) + "grains/", scalar = fmt::format("{}", view.grains->size()), vector = scalar + " 3";
  std::string text = begin(view.time, fmt::format("TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"", scalar),
                           item(vector, "Float", 4, at + "position"));
  text += attribute("radius", "Scalar", item(scalar, "Float", 8, at + "radius"));
  text += attribute("velocity", "Vector", item(vector, "Float", 4, at + "velocity"));
  text += attribute("driven", "Scalar", item(scalar, "Char", 1, at + "driven"));
  text += attribute("id", "Scalar", item(scalar, "Int", 8, at + "id"));
  return text + "\n      </Grid>";
}

}  // namespace

void Xdmf::on_start(const RunStart& start) {
  grid_ = start.grid;
}

void Xdmf::on_frame(const FrameView& view) {
  if (view.h) add(flow_, "flow", flow_grid(view, grid_));
  if (view.grains && view.grains->size() > 0) add(grains_, "grains", grains_grid(view));
}

void Xdmf::state(Archive& a) {
  for (auto& [file, name] : {std::pair{&flow_, "flow"}, std::pair{&grains_, "grains"}}) {
    bool there = file->has_value();
    std::int64_t length = there && !a.loading() ? (*file)->settled() : 0;
    a(there, length);
    if (!a.loading()) continue;
    file->reset();
    if (there) {
      file->emplace(TextFile::reopened(path_of(name), length));
      (*file)->tail(kTail);
    } else {
      std::filesystem::remove(path_of(name));
    }
  }
}

void Xdmf::add(std::optional<TextFile>& file, const std::string& name, const std::string& grid) {
  if (!file) {
    file.emplace(path_of(name));
    file->line_before(head(name), kTail);
  }
  file->line_before(grid, kTail);
}

}  // namespace couloir
