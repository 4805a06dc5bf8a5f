// Runs that take several cores each, on fewer than all would take together.
#include "coupling/cases/cores.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace couloir {
namespace {

TEST(Cores, AreNeverTakenTwice) {
  Cores cores(4);
  std::atomic<int> taken = 0, most = 0, done = 0;
  {
    std::vector<std::jthread> threads;
    for (const int wanted : {2, 3, 1, 2, 9, 1, 0, 2}) {  // 9: all that there are, 0: one
      threads.emplace_back([&, wanted] {
        const int counted = wanted > 4 ? 4 : wanted < 1 ? 1 : wanted;
        const Cores::Hold held(cores, wanted);
        taken += counted;
        for (int seen = most; seen < taken && !most.compare_exchange_weak(seen, taken);) {
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        taken -= counted;
        ++done;
      });
    }
  }
  EXPECT_EQ(done, 8);
  EXPECT_LE(most, 4);
  EXPECT_GE(most, 2);
}

}  // namespace
}  // namespace couloir
