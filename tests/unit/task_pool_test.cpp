// The tree builder's threads: every task runs once, those that tasks spawn too, and a failure reaches the
// caller.
#include "base/task_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace nook {
namespace {

TEST(TaskPool, CoversARangeOnceOnAnyNumberOfThreads) {
  for (const unsigned threads : {1u, 2u, 5u}) {
    TaskPool pool(threads);
    std::vector<std::atomic<int>> seen(1000);
    pool.for_ranges(seen.size(), 7, [&](std::size_t begin, std::size_t end) {
      EXPECT_LE(end - begin, 7u);
      for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const std::atomic<int>& times : seen) EXPECT_EQ(times, 1);
  }
}

TEST(TaskPool, WaitsForWhatTasksSpawn) {
  TaskPool pool(3);
  std::atomic<int> leaves = 0;
  std::function<void(int)> grow = [&](int depth) {
    if (depth == 0) {
      ++leaves;
      return;
    }
    for (int i = 0; i < 2; ++i) pool.spawn([&, depth] { grow(depth - 1); });
  };
  pool.spawn([&] { grow(8); });
  pool.wait();
  EXPECT_EQ(leaves, 256);
}

TEST(TaskPool, ThrowsWhatATaskThrewOnceTheOthersAreDone) {
  for (const unsigned threads : {1u, 4u}) {
    TaskPool pool(threads);
    std::atomic<int> done = 0;
    for (int i = 0; i < 20; ++i)
      pool.spawn([&, i] {
        if (i == 3) throw std::runtime_error("no memory");
        ++done;
      });
    EXPECT_THROW(pool.wait(), std::runtime_error);
    EXPECT_EQ(done, 19);
    pool.spawn([&] { ++done; });
    pool.wait();  // a failure is told once
    EXPECT_EQ(done, 20);
  }
}

}  // namespace
}  // namespace nook
