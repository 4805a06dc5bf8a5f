#include "coupling/scene/bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "coupling/scene/scene_error.hpp"
#include "coupling/scene/solid_body.hpp"
#include "coupling/scene/stl_file.hpp"
#include "coupling/scene/units.hpp"

namespace couloir {
namespace {

constexpr std::size_t most_triangles = 50'000;
constexpr double least_base = 1e-4;  // of its shadow: less is a point or an edge

std::string len(double value) {
  return short_quantity(value, Dimension::length);
}

double metres(const std::string& unit) {
  return unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : 1.0;
}

class Reader {
 public:
  Reader(Scene& scene, ObstacleSpec& o, const std::string& folder)
      : scene_(scene), o_(o), folder_(folder), key_("obstacles." + o.name) {}

  void read() {
    if (o_.vertices.empty() != o_.faces.empty())
      fail(o_.faces.empty() ? ".vertices" : ".faces", "comes alone; vertices and faces belong together, or give a file");
    if (o_.vertices.empty()) read_file();
    from_ = o_.file.empty() ? ".faces" : ".file";
    check_faces();
    const TriangleMesh mesh{o_.vertices, o_.faces};
    if (const std::string flaw = flaw_of(mesh); !flaw.empty()) fail_body(flaw);
    stand(mesh);
  }

 private:
  [[noreturn]] void fail(const std::string& member, const std::string& what) const {
    throw SceneError(fmt::format("{}: {} {}", scene_.places.of(key_ + member), key_ + member, what));
  }
  [[noreturn]] void fail_body(const std::string& what) const {
    fail(from_, from_ == ".file" ? fmt::format("({}) {}", o_.file, what) : what);
  }

  void read_file() {
    if (o_.file.empty()) fail("", "is of shape mesh, but has no file; give the path of an STL file, from the scene's folder");
    from_ = ".file";
    try {
      std::vector<BodyTriangle> triangles;
      for (const StlTriangle& t : read_stl((std::filesystem::path(folder_) / o_.file).string())) {
        triangles.push_back(t);
        for (BodyPoint& p : triangles.back())
          for (double& x : p) x *= metres(o_.unit);
      }
      if (triangles.size() > most_triangles)
        fail_body(fmt::format("has {} triangles, more than {}; simplify it: grains are larger than its details", triangles.size(),
                              most_triangles));
      TriangleMesh mesh = welded(triangles);
      o_.vertices = std::move(mesh.vertices), o_.faces = std::move(mesh.faces);
    } catch (const StlError& error) {
      fail_body(error.what());
    }
  }

  void check_faces() const {
    if (o_.faces.size() > most_triangles)
      fail(".faces", fmt::format("has {} triangles, more than {}", o_.faces.size(), most_triangles));
    for (std::size_t n = 0; n < o_.faces.size(); ++n)
      for (const int v : o_.faces[n])
        if (v < 0 || v >= int(o_.vertices.size()))
          fail(".faces", fmt::format("names vertex {} in row {}; there are {}, counted from 0", v, n + 1, o_.vertices.size()));
  }

  void stand(const TriangleMesh& mesh) {
    auto body = std::make_shared<SolidBody>(mesh, o_.rotation);
    if (body->height() <= 0)
      fail_body(fmt::format("has nothing above the bed, z = 0: its lowest point is at {}; move it up", len(body->lowest())));
    if (body->lowest() > 0)
      fail_body(fmt::format("has no base on the bed: its lowest point is at z = {}, the bed is at 0; move it down",
                            len(body->lowest())));
    if (body->base_area() < least_base * body->plan_area())
      fail_body(
          "has no base on the bed: it touches z = 0 with a point or an edge only; move it down, what reaches below is cut off");
    o_.length = body->length(), o_.width = body->width(), o_.height = body->height();
    if (std::max(o_.length, o_.width) > 1e3 * (scene_.terrain.total_length() + scene_.terrain.width))
      fail_body(fmt::format("is {} by {}, a thousand times the terrain; its unit is {}, is that right?", len(o_.length),
                            len(o_.width), o_.unit));
    o_.body = std::move(body);
  }

  Scene& scene_;
  ObstacleSpec& o_;
  const std::string& folder_;
  std::string key_, from_;
};

}  // namespace

void read_bodies(Scene& scene, const std::string& folder) {
  for (ObstacleSpec& o : scene.obstacles)
    if (o.shape == ObstacleSpec::Shape::mesh) Reader(scene, o, folder).read();
}

}  // namespace couloir
