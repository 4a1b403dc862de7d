#pragma once

#include <string>

namespace nook {

/// Makes a folder for PoCL's intermediate files, of this process alone and removed when it ends, and names it
/// in POCL_CACHE_DIR, before PoCL is loaded. PoCL would otherwise keep them in ~/.cache/pocl and trust
/// whatever it finds there: a file that a full disk cut short ends the process in a signal. What is worth
/// keeping is in nook's own cache, with checksums (program_cache.hpp). Folders that killed processes left
/// behind are removed. Does nothing where POCL_CACHE_DIR is set (so a second call does nothing), or where no
/// folder can be made for want of a right to; for want of room, see problem_of_pocl_folder(). Sets an
/// environment variable: call it while no other thread reads them.
void give_pocl_its_own_folder();

/// One line that names the folder and the error, if there was no room for it or for 4 MiB in it (PoCL would
/// end the process); else empty.
const std::string& problem_of_pocl_folder();

}  // namespace nook
