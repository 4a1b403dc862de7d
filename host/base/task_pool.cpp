#include "base/task_pool.hpp"

#include <system_error>
#include <utility>

namespace nook {

TaskPool::TaskPool(unsigned threads) {
  const auto work = [this] {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
      if (stopping_) return;
      run_one(lock);
    }
  };
  try {
    for (unsigned i = 1; i < threads; ++i) workers_.emplace_back(work);
  } catch (const std::system_error&) {
    // The system gives no more threads: those there are do the work.
  }
}

TaskPool::~TaskPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void TaskPool::spawn(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    ++open_;
  }
  changed_.notify_one();
}

void TaskPool::run_one(std::unique_lock<std::mutex>& lock) {
  const std::function<void()> task = std::move(tasks_.front());
  tasks_.pop_front();
  lock.unlock();
  std::exception_ptr failure;
  try {
    task();
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  if (failure && !failure_) failure_ = failure;
  if (--open_ == 0) changed_.notify_all();
}

void TaskPool::wait() {
  std::unique_lock lock(mutex_);
  while (open_ > 0) {
    if (!tasks_.empty())
      run_one(lock);
    else
      changed_.wait(lock, [this] { return open_ == 0 || !tasks_.empty(); });
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace nook
