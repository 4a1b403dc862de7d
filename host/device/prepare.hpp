#pragma once

namespace nook {

/// Settles what a process can say of OpenCL once, before the first list_devices() or select_device(): threads
/// to use, of CPU devices and of nook itself (0: one for each processor that it may use), and the environment
/// that PoCL reads (prepare_for_pocl()). Call it while no other thread reads environment variables. Throws
/// Error(device).
void prepare_for_opencl(unsigned threads);

}  // namespace nook
