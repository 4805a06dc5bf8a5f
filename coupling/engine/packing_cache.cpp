#include "coupling/engine/packing_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace couloir {

namespace {

constexpr const char* title = "couloir packing 1";
constexpr const char* columns = "# x y z r [m]";

}  // namespace

std::string describe(const PackingSpec& s) {
  std::string text = fmt::format(
      "diameter {:.17g} spread {:.17g} length {:.17g} width {:.17g} depth {:.17g} seed {} friction {:.17g} base_friction {:.17g} "
      "rolling_friction {:.17g} base_rolling_friction {:.17g} restitution {:.17g} youngs_modulus {:.17g} poisson_ratio {:.17g} "
      "density {:.17g} contact {}",
      s.diameter, s.spread, s.length, s.width, s.depth, s.seed, s.friction, s.base_friction, s.rolling_friction,
      s.base_rolling_friction, s.restitution, s.youngs_modulus, s.poisson_ratio, s.density,
      contact_name(s.contact, s.tangential_damping));
  if (s.rotation != Rotation::free) text += fmt::format(" rotation {}", to_string(s.rotation));
  if (s.rotation == Rotation::control) {
    const RotationControl& c = s.control;
    text += fmt::format(" retarding_time {:.17g} contact_influence {:.17g} shear_influence {:.17g} thresholds {:.17g} {:.17g}",
                        c.retarding_time, c.contact_influence, c.shear_influence, c.slide_to_roll, c.roll_to_slide);
  }
  return text;
}

std::string packing_file(const PackingSpec& spec, const std::string& cache) {
  std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
  for (const char c : std::string(title) + describe(spec)) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return fmt::format("{}/packing-{:016x}.txt", cache, hash);
}

std::optional<Packing> read_packing(const PackingSpec& spec, const std::string& cache) {
  std::ifstream in(packing_file(spec, cache));
  std::string line;
  if (!std::getline(in, line) || line != title) return {};
  if (!std::getline(in, line) || line != describe(spec)) return {};
  Packing packing;
  std::size_t count = 0;
  if (!(in >> packing.length >> packing.width >> packing.depth >> packing.solid_fraction >> count)) return {};
  in.ignore();
  if (!std::getline(in, line) || line != columns) return {};
  Packing::Grain g{};
  while (in >> g.x >> g.y >> g.z >> g.r) packing.grains.push_back(g);
  if (packing.grains.size() != count || count == 0) return {};
  return packing;
}

bool write_packing(const PackingSpec& spec, const Packing& packing, const std::string& cache) {
  std::error_code error;
  std::filesystem::create_directories(cache, error);
  const std::string file = packing_file(spec, cache), part = fmt::format("{}.{}.part", file, getpid());
  std::ofstream out(part);
  out << title << '\n' << describe(spec) << '\n';
  out << fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {}\n", packing.length, packing.width, packing.depth, packing.solid_fraction,
                     packing.grains.size());
  out << columns << '\n';
  for (const Packing::Grain& g : packing.grains) out << fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", g.x, g.y, g.z, g.r);
  out.close();
  if (out) std::filesystem::rename(part, file, error);
  if (out && !error) return true;
  std::filesystem::remove(part, error);
  return false;
}

}  // namespace couloir
