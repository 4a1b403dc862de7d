#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace nook {

/// Threads that work on tasks until none is left. The order in which tasks run is open: results must not
/// depend on it.
///
///     TaskPool pool(threads);
///     pool.spawn([&] { build(root); });  // a task may spawn others
///     pool.wait();
class TaskPool {
 public:
  /// `threads` at least 1, with the caller's: 1 starts none.
  explicit TaskPool(unsigned threads);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  unsigned threads() const { return unsigned(workers_.size()) + 1; }

  void spawn(std::function<void()> task);
  /// Works with the others until every task is done; throws what the first failing task threw, once the
  /// others are done. Not to be called from a task.
  void wait();

  /// body(begin, end) over [0, count) in pieces of at most `grain`, and waits.
  template <class Body>
  void for_ranges(std::size_t count, std::size_t grain, const Body& body) {
    if (count <= grain) {
      if (count) body(std::size_t(0), count);
      return;
    }
    for (std::size_t begin = 0; begin < count; begin += grain)
      spawn([&body, begin, end = std::min(count, begin + grain)] { body(begin, end); });
    wait();
  }

 private:
  // Runs one task; called and left with the lock held.
  void run_one(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::size_t open_ = 0;  // waiting or running
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> workers_;
};

}  // namespace nook
