#pragma once
#include <cstddef>
#include <functional>
#include <stdexcept>

namespace couloir {

// The user stopped the work before this run was done.
struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("stopped by the user") {}
};

// Calls work(0), work(1), ... once each, `jobs` at a time, on threads of its own, and returns when all have ended; no more are
// begun once stop() is true or one has thrown, whose error is thrown again here. Stopped is no error: the others then end as
// they will. `tick` is called in between, by the caller's thread, some times a second.
void share_out(
    std::size_t count, int jobs, const std::function<void(std::size_t)>& work, const std::function<bool()>& stop,
    const std::function<void()>& tick = [] {});

}  // namespace couloir
