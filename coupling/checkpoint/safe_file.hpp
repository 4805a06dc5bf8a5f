#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace couloir {

// Writes a file whole or not at all, also where the power fails: beside it, to the disk, renamed. Throws CheckpointError.
void write_safely(const std::string& path, std::span<const std::uint8_t> bytes);

// Has the system put on the disk what was written into the file. Throws CheckpointError.
void sync_file(const std::string& path);

}  // namespace couloir
