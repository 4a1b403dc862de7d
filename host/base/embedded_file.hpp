#pragma once

namespace nook {

/// A text file compiled into the binary; `path` is relative to the repository root
/// ("kernels/sample/warp.cl").
struct EmbeddedFile {
  const char* path;
  const char* text;
};

}  // namespace nook
