#include "coupling/workers/engine_errors.hpp"

#include <liggghts/compute.h>

#include <string>

#include "coupling/workers/engine_headers.hpp"

namespace {

std::string place(const char* file, int line) {
  const std::string path = file;
  return " (" + path.substr(path.rfind('/') + 1) + ":" + std::to_string(line) + ")";
}

[[noreturn]] void raise(const std::string& text, const char* file, int line, bool everywhere) {
  throw couloir::EngineFailure(text + place(file, line), everywhere);
}

}  // namespace

namespace LAMMPS_NS {

void Error::all(const char* file, int line, const char* text) {
  raise(text, file, line, true);
}
void Error::one(const char* file, int line, const char* text) {
  raise(text, file, line, false);
}
void Error::cg(const char* file, int line, const char* text) {
  raise(std::string("not possible with coarse graining: ") + text, file, line, true);
}
void Error::fix_error(const char* file, int line, Fix* fix, const char* text) {
  raise(std::string("fix ") + fix->style + " (id " + fix->id + "): " + text, file, line, true);
}
void Error::fix_error(const char* file, int line, Fix* fix, const char* style, const char* text) {
  raise(std::string("fix ") + style + " (id " + fix->id + "): " + text, file, line, true);
}
void Error::compute_error(const char* file, int line, Compute* compute, const char* text) {
  raise(std::string("compute ") + compute->style + " (id " + compute->id + "): " + text, file, line, true);
}

}  // namespace LAMMPS_NS
