#pragma once
// Working arrays by cell that suit wide loads: a block's cell (0, 0) begins a cache line, and so do the other rows where the row
// has a multiple of eight cells, every other one where it has a multiple of four.

#include <cstddef>
#include <new>
#include <vector>

#include "continuum/mesh/block.hpp"

namespace couloir {

template <class T>
struct RowAllocator {
  using value_type = T;
  static constexpr std::size_t line = 64, before = line - Block::ghosts * sizeof(T) % line;  // [bytes]

  RowAllocator() = default;
  template <class U>
  RowAllocator(const RowAllocator<U>&) {}
  T* allocate(std::size_t n) {
    void* bytes = ::operator new(n * sizeof(T) + line, std::align_val_t(line));
    return reinterpret_cast<T*>(static_cast<std::byte*>(bytes) + before);
  }
  void deallocate(T* p, std::size_t) noexcept {
    ::operator delete(reinterpret_cast<std::byte*>(p) - before, std::align_val_t(line));
  }
  bool operator==(const RowAllocator&) const = default;
};

using Values = std::vector<double, RowAllocator<double>>;

}  // namespace couloir
