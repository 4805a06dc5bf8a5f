#include "coupling/cases/share_out.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace couloir {

void share_out(std::size_t count, int jobs, const std::function<void(std::size_t)>& work, const std::function<bool()>& stop,
               const std::function<void()>& tick) {
  std::mutex mutex;
  std::condition_variable ended;
  std::exception_ptr error;
  std::size_t next = 0;
  int busy = std::min(jobs, static_cast<int>(count));
  const auto take = [&](std::size_t& mine) {
    const std::lock_guard lock(mutex);
    if (error || next >= count || stop()) return false;
    mine = next++;
    return true;
  };
  const auto run = [&] {
    for (std::size_t mine = 0; take(mine);) {
      try {
        work(mine);
      } catch (const Stopped&) {
        break;
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
      }
    }
    const std::lock_guard lock(mutex);
    --busy;
    ended.notify_one();
  };
  std::vector<std::jthread> workers;
  for (int k = busy; k > 0; --k) workers.emplace_back(run);
  for (std::unique_lock lock(mutex); busy > 0;) {
    if (ended.wait_for(lock, std::chrono::milliseconds(250), [&] { return busy == 0; })) break;
    lock.unlock();
    tick();
    lock.lock();
  }
  workers.clear();  // joins
  if (error) std::rethrow_exception(error);
}

}  // namespace couloir
