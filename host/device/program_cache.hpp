#pragma once

#include <filesystem>
#include <string>

#include "device/device.hpp"

namespace nook {

/// Options of a kernel build: "-DEFFECT=0 -DSAMPLING=2 ...". Ordered, so that equal settings give equal text.
class BuildOptions {
 public:
  BuildOptions& define(const std::string& name, long value);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A built program and where it came from.
struct BuiltProgram {
  ClProgram program;
  bool from_cache = false;
  double seconds = 0;
  std::filesystem::path cache_entry;  ///< where store() writes it; empty if it need not be stored

  /// Throws Error(device) if the program has no kernel of this name.
  ClKernel kernel(const char* name) const;

  enum class Groups { any, of_one };

  /// Writes a program that was compiled to the disk cache. Apart from build_program, because asking PoCL for
  /// a binary compiles every kernel once more (0.8 s each), which no user should wait for before the picture;
  /// unless its kernels have run, and only in work-groups of one item each. A failure only costs the next
  /// run.
  void store(Groups launched = Groups::any) noexcept;
};

/// The folder of cached program binaries: NOOK_CACHE_DIR, else $XDG_CACHE_HOME/nook, else ~/.cache/nook;
/// empty if none is known.
std::filesystem::path program_cache_dir();

/// Builds flattened source for the device, or takes the binary from the disk cache. The key covers source,
/// options, device name, driver and platform; an entry is trusted only if its checksum holds, is written
/// under a temporary name and renamed (two processes may share the folder), and a failure to read or write it
/// only costs a build. Throws Error(device) with the build log, which names kernels/FILE:LINE.
BuiltProgram build_program(const Device& device, const std::string& source, const BuildOptions& options);

}  // namespace nook
