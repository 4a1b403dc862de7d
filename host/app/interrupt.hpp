#pragma once

namespace nook {

/// From now on SIGINT, SIGTERM and SIGHUP (a terminal that goes away) set a flag instead of ending the
/// process, unless they are ignored; a second signal ends it at once. Call it after OpenCL is loaded: PoCL's
/// LLVM installs handlers of its own.
void catch_interrupts();

/// True once a signal has come.
bool interrupted();

}  // namespace nook
