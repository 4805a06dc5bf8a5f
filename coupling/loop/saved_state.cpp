#include "coupling/loop/saved_state.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace couloir {

void save_bytes(const std::string& folder, const std::string& name, const std::vector<std::uint8_t>& bytes) {
  const std::filesystem::path target = std::filesystem::path(folder) / name, part = target.string() + ".part";
  std::ofstream out(part, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error(target.string() + " could not be written: " + std::strerror(errno));
  std::filesystem::rename(part, target);
}

}  // namespace couloir
