#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nook {

/// What a caller can do about an error. The command line's exit codes are in app/exit_code.hpp.
enum class ErrorKind {
  internal,    ///< a defect in nook
  usage,       ///< what was asked for contradicts itself
  scene,       ///< scene file, mesh, material, points
  device,      ///< OpenCL or OpenGL
  output,      ///< a file could not be written
  incomplete,  ///< something of a picture is missing
  interrupted  ///< cancelled
};

/// Where in a user's file: row and column from 1, 0 if they are not known.
struct Place {
  std::string file;
  std::uint64_t row = 0, column = 0;
};

/// The one exception type: a kind and a message of one line that names the user's file and place.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  /// The message is "<file>:<row>:<column>: <what>", or without a file `what` alone.
  Error(ErrorKind kind, Place place, std::string_view what);
  /// The same error with `more` said after its message.
  Error(const Error& error, const std::string& more)
      : std::runtime_error(error.what() + more), kind_(error.kind_), place_(error.place_) {}

  ErrorKind kind() const { return kind_; }
  /// Its file is empty if the error is of none, or names it in words alone.
  const Place& place() const { return place_; }

 private:
  ErrorKind kind_;
  Place place_;
};

}  // namespace nook
