#pragma once

#include <stdexcept>
#include <string>

namespace nook::test {

/// Kernel source with a defect planted: `find`, which must occur exactly once, becomes `replace`. A mutant
/// that no longer applies is an error, not a pass.
inline std::string mutate(std::string source, const std::string& find, const std::string& replace) {
  std::size_t at = source.find(find);
  if (at == std::string::npos) throw std::logic_error("the mutant does not apply: `" + find + "` not found");
  if (source.find(find, at + 1) != std::string::npos)
    throw std::logic_error("the mutant is ambiguous: `" + find + "`");
  return source.replace(at, find.size(), replace);
}

}  // namespace nook::test
