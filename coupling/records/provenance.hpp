#pragma once
// What made a record: nothing that names a host, a user or a place.
#include <string>
#include <utility>
#include <vector>

namespace couloir {

struct Provenance {
  std::string version;          // of couloir, "0.1.0"
  std::string revision;         // git commit, "-dirty" where the tree differed from it; "unknown" outside of a git tree
  std::string compiler;         // "GNU 12.2.0"
  std::string flags;            // that the sources were compiled with
  std::string cpu;              // model name; "unknown" where the system does not tell
  std::string instruction_set;  // of the continuum's kernels (continuum/isa/isa.hpp)
  std::string libraries;        // "HDF5 1.10.8, Eigen 3.4.0, ..."
};

const Provenance& provenance();

// Tells apart programs whose bits may differ: the revision, and a number for the compiler and its flags, or for the program's own
// bytes where its tree had no revision. `program`: its path.
std::string build_identity(const std::string& program);

// The same as the attributes of a file of this format: names and texts.
std::vector<std::pair<std::string, std::string>> provenance_attributes(const std::string& format);

}  // namespace couloir
