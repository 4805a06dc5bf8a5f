#pragma once
// So many cores, shared by threads that each wait for as many as their run takes.

#include <algorithm>
#include <condition_variable>
#include <mutex>

namespace couloir {

class Cores {
 public:
  explicit Cores(int all) : all_(all), free_(all) {}

  // Held until it ends. Whoever asked first is served first; more than there are counts as all.
  class Hold {
   public:
    Hold(Cores& cores, int wanted) : cores_(cores), count_(std::clamp(wanted, 1, cores.all_)) {
      std::unique_lock lock(cores_.mutex_);
      const long mine = cores_.asked_++;
      cores_.changed_.wait(lock, [&] { return cores_.served_ == mine && cores_.free_ >= count_; });
      ++cores_.served_;
      cores_.free_ -= count_;
      cores_.changed_.notify_all();
    }
    ~Hold() {
      const std::lock_guard lock(cores_.mutex_);
      cores_.free_ += count_;
      cores_.changed_.notify_all();
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    Cores& cores_;
    int count_;
  };

 private:
  const int all_;
  int free_;
  long asked_ = 0, served_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace couloir
