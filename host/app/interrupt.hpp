#pragma once

namespace nook {

/// From now on SIGINT and SIGTERM set a flag instead of ending the process; a second signal ends it at once.
/// Call it after OpenCL is loaded: PoCL's LLVM installs handlers of its own.
void catch_interrupts();

/// True once a signal has come.
bool interrupted();

}  // namespace nook
