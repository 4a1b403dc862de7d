#include "jobs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "base/error.hpp"
#include "device/prepare.hpp"

namespace nook::python {
namespace {

using namespace std::chrono_literals;
constexpr auto between_looks = 20ms, patience = 120ms;

std::atomic<pid_t> process_of_opencl = 0;

// One piece of work, and what its two threads tell each other.
struct Job : RunObserver {
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false, news = false;
  std::exception_ptr error;
  RunProgress latest;
  std::vector<std::string> warnings;
  std::atomic<bool> cancel = false;

  void progress(const RunProgress& now) override {
    const std::lock_guard lock(mutex);
    latest = now;
    news = true;
  }
  bool cancelled() override { return cancel; }
  void warn(const std::string& line) override {
    const std::lock_guard lock(mutex);
    warnings.push_back(line);
  }
  // Whether it is done.
  bool wait(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, time, [&] { return done; });
  }
};

// Those that run, in whatever process started them.
struct {
  std::mutex mutex;
  std::condition_variable changed;
  unsigned count = 0;
  pid_t process = 0;
} running;

void start(std::shared_ptr<Job> job, std::function<void(RunObserver&)> work) {
  {
    const std::lock_guard lock(running.mutex);
    if (running.process != getpid()) running.count = 0;
    running.process = getpid();
    ++running.count;
  }
  std::thread([job = std::move(job), work = std::move(work)]() mutable {
    std::exception_ptr error;
    try {
      if (job->cancel) throw Error(ErrorKind::interrupted, "interrupted");
      work(*job);
    } catch (...) {
      error = std::current_exception();
    }
    work = nullptr;  // what it owns goes before the job counts as done
    {
      const std::lock_guard lock(job->mutex);
      job->error = error;
      job->done = true;
    }
    job->changed.notify_all();
    const std::lock_guard lock(running.mutex);
    --running.count;
    running.changed.notify_all();
  }).detach();
}

// NOOK_THREADS; 0, for all, if it is not set.
unsigned threads_of_environment() {
  const char* text = std::getenv("NOOK_THREADS");
  if (!text || !*text) return 0;
  unsigned threads = 0;
  const char* end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, threads);
  if (read.ec != std::errc() || read.ptr != end)
    throw Error(ErrorKind::usage, fmt::format("NOOK_THREADS: '{}' is not a number of threads", text));
  return threads;
}

void call(PyObject* progress, const RunProgress& now) {
  Object(PyObject_CallFunction(progress, "KKKdd", static_cast<unsigned long long>(now.samples),
                               static_cast<unsigned long long>(now.total),
                               static_cast<unsigned long long>(now.rays), now.error, now.share_done));
}

// With the GIL: what Python has to do about the job now. Throws ErrorIsSet.
void attend(Job& job, PyObject* progress) {
  if (PyErr_CheckSignals() != 0) throw ErrorIsSet();
  if (progress == Py_None) return;
  RunProgress now;
  {
    const std::lock_guard lock(job.mutex);
    if (!std::exchange(job.news, false)) return;
    now = job.latest;
  }
  call(progress, now);
}

}  // namespace

bool is_forked() {
  return process_of_opencl != 0 && process_of_opencl != getpid();
}

void check_fork() {
  if (is_forked())
    throw Error(
        ErrorKind::device,
        "OpenCL was used before this process was forked, and cannot be used in it: start processes by "
        "\"spawn\" or \"forkserver\" (multiprocessing.get_context), or fork before the first estimate");
}

void use_device() {
  check_fork();
  const unsigned threads = threads_of_environment();
  if (process_of_opencl.exchange(getpid()) == 0) prepare_for_opencl(threads);
}

void run_job(PyObject* progress, std::function<void(RunObserver&)> work) {
  const auto job = std::make_shared<Job>();
  start(job, std::move(work));
  const auto done_within = [&](std::chrono::milliseconds time) {
    const WithoutGil others_run;
    return job->wait(time);
  };
  try {
    while (!done_within(between_looks)) attend(*job, progress);
    attend(*job, progress);
  } catch (const ErrorIsSet&) {
    job->cancel = true;
    done_within(patience);
    throw;
  }
  if (job->error) std::rethrow_exception(job->error);
  warn(job->warnings);
}

void warn(const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  const Object module(PyImport_ImportModule("nook._errors"));
  const Object category(PyObject_GetAttrString(module.get(), "SceneWarning"));
  for (const std::string& line : lines)
    if (PyErr_WarnEx(category.get(), line.c_str(), 3) != 0) throw ErrorIsSet();
}

void wait_for_jobs() {
  const WithoutGil others_run;
  if (running.process != getpid()) return;
  std::unique_lock lock(running.mutex);
  running.changed.wait(lock, [] { return running.count == 0; });
}

}  // namespace nook::python
