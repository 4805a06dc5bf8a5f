#include "coupling/records/provenance.hpp"

#include <fmt/core.h>
#include <hdf5.h>

#include <Eigen/Core>
#include <fstream>
#include <nlohmann/json.hpp>

#include "continuum/isa/isa.hpp"
#include "continuum/mesh/mpi_session.hpp"
#include "couloir_build.hpp"
#include "coupling/checkpoint/checksum.hpp"
#include "coupling/records/h5.hpp"
#include "coupling/records/text_file.hpp"

namespace couloir {
namespace {

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const auto colon = line.find(':');
    if (colon != std::string::npos && colon + 2 < line.size()) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string library_versions() {
  unsigned major = 0, minor = 0, release = 0;
  h5::set_up_library();
  H5get_libversion(&major, &minor, &release);
  return fmt::format("HDF5 {}.{}.{}, Eigen {}.{}.{}, fmt {}.{}.{}, nlohmann-json {}.{}.{}, {}", major, minor, release,
                     EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                     FMT_VERSION % 100, NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH,
                     mesh_library_versions());
}

}  // namespace

const Provenance& provenance() {
  static const Provenance made{build::kVersion, build::kRevision,        build::kCompiler,  build::kFlags,
                               cpu_model(),     to_string(chosen_isa()), library_versions()};
  return made;
}

std::string build_identity(const std::string& program) {
  const Provenance& made = provenance();
  const bool whole = made.revision != "unknown" && !made.revision.ends_with("-dirty");
  const std::string of = whole ? made.compiler + made.flags : read_text(program);
  return fmt::format("{}, build {:08x}", made.revision, static_cast<std::uint32_t>(checksum(of.data(), of.size())));
}

std::vector<std::pair<std::string, std::string>> provenance_attributes(const std::string& format) {
  const Provenance& made = provenance();
  return {{"format", format},
          {"couloir_version", made.version},
          {"git_revision", made.revision},
          {"compiler", made.compiler},
          {"compiler_flags", made.flags},
          {"cpu", made.cpu},
          {"instruction_set", made.instruction_set},
          {"libraries", made.libraries}};
}

}  // namespace couloir
