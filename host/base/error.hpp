#pragma once

#include <stdexcept>
#include <string>

namespace nook {

/// What the process returns; documented in the README and in `nook --help`.
enum class ExitCode : int {
  ok = 0,
  internal = 1,  ///< a defect in nook
  usage = 2,     ///< command line
  scene = 3,     ///< scene file, mesh, material, points
  device = 4,    ///< OpenCL or OpenGL
  target = 5,    ///< an error or time target was missed
  output = 6,    ///< a file could not be written
  interrupted = 130
};

/// The one exception type: a message of one line that names the user's file and place, and the exit code.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace nook
