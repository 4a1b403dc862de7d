#pragma once

#include <string>

namespace nook {

/// An embedded kernel file ("stage/primary.cl") with its includes replaced by their text, each once, and
/// #line markers, so that a build error names `kernels/sample/warp.cl:18`. Throws Error(internal) for a file
/// that is not embedded.
std::string kernel_source(const std::string& file);

/// The same for source text given by the caller; `name` is what errors call it. Includes are looked up in
/// kernels/.
std::string flatten_kernel(const std::string& name, const std::string& text);

}  // namespace nook
