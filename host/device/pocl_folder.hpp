#pragma once

#include <optional>

#include "base/error.hpp"

namespace nook {

/// Settles what PoCL reads of the environment, once, before it is loaded; a second call does nothing.
///
/// Throws Error(device) where PoCL would end the process (check_what_pocl_needs()). Makes a folder for its
/// intermediate files, of this process alone and removed when it ends, and names it in POCL_CACHE_DIR: PoCL
/// would otherwise keep them in ~/.cache/pocl and trust whatever it finds there; a file that a full disk cut
/// short ends the process in a signal. What is worth keeping is in nook's own cache, with checksums
/// (program_cache.hpp). Where that cannot be written, or programs may not be run from there, the folder is a
/// private one in TMPDIR, /tmp or /var/tmp. Folders that killed processes left behind are removed. A
/// POCL_CACHE_DIR of the user's is used as it is; that of a process which started this one is not.
///
/// Sets environment variables: call it while no other thread reads them.
void prepare_for_pocl();

/// For programs whose work-groups have one work-item wherever they are launched: of what PoCL has compiled in
/// this process's folder for such groups, makes its code for groups of any size too. PoCL keeps code of both
/// kinds in a program's binary, compiles for the size at the first launch, and would compile each kernel once
/// more (0.8 s) when it is asked for the binary, for sizes that are never launched. Where PoCL names its
/// files otherwise, nothing is found, and it compiles.
void reuse_code_of_single_items();

/// Why PoCL can use no folder: Error(output) if there was no room for it or for 4 MiB in it, else
/// Error(device), each naming the folder. PoCL then offers no device, or ends the process when it is used.
const std::optional<Error>& problem_of_pocl_folder();

}  // namespace nook
