#pragma once
// Blocks that have been made once, as text files that state what they are.

#include <optional>
#include <string>

#include "coupling/engine/packing.hpp"

namespace couloir {

// One line that says all of a spec, exactly.
std::string describe(const PackingSpec&);

// <cache>/packing-<hash of the description>.txt
std::string packing_file(const PackingSpec&, const std::string& cache);

// Nothing where the file is missing, of another spec, or damaged: it is made again then.
std::optional<Packing> read_packing(const PackingSpec&, const std::string& cache);

// Under another name first, so that a reader never sees half a file. False: the folder cannot be written.
bool write_packing(const PackingSpec&, const Packing&, const std::string& cache);

}  // namespace couloir
