#pragma once

#include <functional>
#include <string>
#include <vector>

#include "object.hpp"
#include "render/observer.hpp"

namespace nook::python {

/// Throws Error(device) in a process that was forked from one where OpenCL was used: its threads are not
/// there, and a call would wait for ever.
void check_fork();
/// Before a device is opened: the same, and settles once what OpenCL reads of the environment (NOOK_THREADS:
/// the number of threads).
void use_device();
/// Whether what was made with OpenCL is another process's, and cannot even be destroyed here.
bool is_forked();

/// Runs `work` in a thread of its own and waits for it without the GIL. Python's signals are handled
/// meanwhile, and `progress` (None, or a function of samples, total, rays, error, share done) is called, in
/// the thread that called this. Ctrl-C, or an error of `progress`, cancels the work; if that does not end
/// within a moment, it goes on alone until it next asks, and this throws at once. So `work` must own all that
/// it uses. Warnings of the observer become Python's. Throws what `work` threw.
void run_job(PyObject* progress, std::function<void(RunObserver&)> work);

/// Python's warnings of nook.SceneWarning.
void warn(const std::vector<std::string>& lines);

/// Waits for works that go on alone; to be called before the process ends.
void wait_for_jobs();

}  // namespace nook::python
