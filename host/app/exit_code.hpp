#pragma once

#include "base/error.hpp"

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

inline ExitCode exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return ExitCode::usage;
    case ErrorKind::scene:
      return ExitCode::scene;
    case ErrorKind::device:
      return ExitCode::device;
    case ErrorKind::output:
      return ExitCode::output;
    case ErrorKind::incomplete:
      return ExitCode::target;
    case ErrorKind::interrupted:
      return ExitCode::interrupted;
    default:
      return ExitCode::internal;
  }
}

/// Of a process of nook's that ended with `code`.
inline ErrorKind error_kind(int code) {
  for (const ErrorKind kind : {ErrorKind::usage, ErrorKind::scene, ErrorKind::device, ErrorKind::output,
                               ErrorKind::incomplete, ErrorKind::interrupted})
    if (int(exit_code(kind)) == code) return kind;
  return ErrorKind::internal;
}

}  // namespace nook
