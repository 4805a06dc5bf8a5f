#include "bench/flow/heap_bytes.hpp"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> held{0};

void* counted(void* p) {
  if (!p) throw std::bad_alloc();
  held += static_cast<long>(malloc_usable_size(p));
  return p;
}

void release(void* p) {
  held -= static_cast<long>(malloc_usable_size(p));
  std::free(p);
}

}  // namespace

void* operator new(std::size_t n) {
  return counted(std::malloc(n));
}
void* operator new(std::size_t n, std::align_val_t a) {
  const auto line = static_cast<std::size_t>(a);
  return counted(std::aligned_alloc(line, (n + line - 1) / line * line));
}
void operator delete(void* p) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t) noexcept {
  release(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  release(p);
}

namespace couloir::bench {

long heap_bytes() {
  return held;
}

}  // namespace couloir::bench
