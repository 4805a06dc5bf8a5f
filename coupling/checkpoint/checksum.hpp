#pragma once
#include <cstddef>
#include <cstdint>

namespace couloir {

// FNV-1a, 64 bits.
inline std::uint64_t checksum(const void* data, std::size_t size) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (const auto* p = static_cast<const unsigned char*>(data); size > 0; ++p, --size) sum = (sum ^ *p) * 0x100000001b3;
  return sum;
}

}  // namespace couloir
