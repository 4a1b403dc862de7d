#pragma once

namespace nook {

/// What PoCL needs of the machine besides a folder for its files (pocl_folder.hpp), and ends the process by a
/// signal, or hangs, without: a stack for its compiler, address space, open files, threads and a linker in
/// PATH (PoCL 3.1: also the processors' topology in /sys). Raises the soft limits of the stack and of open
/// files, and appends the system's folders to PATH where it names no linker. Throws Error(device), one line,
/// for what is wanting. Does nothing where PoCL is no driver of the system's loader. Call it before OpenCL is
/// loaded, and while no other thread runs: it sets an environment variable.
void check_what_pocl_needs(unsigned threads);

}  // namespace nook
