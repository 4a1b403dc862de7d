#pragma once

#include <sys/resource.h>

#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "small_scene.hpp"

namespace nook::test {

/// One row of the table of bad input. Every row starts from a good scene.toml and mesh.obj in a folder of its
/// own.
struct BadInput {
  const char* name;
  std::string command;  ///< what follows `nook`, split at blanks
  int code;             ///< the exit code
  std::string says;     ///< a part of the one line on stderr
  std::vector<std::pair<std::string, std::string>> files =
      {};  ///< written before, instead of or beside the good ones
  std::vector<std::string> folders = {}, fifos = {};
  std::vector<std::string> before = {};                          ///< commands that succeed
  std::function<void(const std::filesystem::path&)> spoil = {};  ///< then this
  std::vector<std::pair<std::string, std::string>> environment = {};
  std::vector<std::pair<int, rlim_t>> limits = {};  ///< RLIMIT_FSIZE and the like
  std::string standard_output = {};
};

inline void PrintTo(const BadInput& row, std::ostream* out) {
  *out << row.name;
}

std::vector<BadInput> bad_input_rows();

/// A command line split at blanks.
std::vector<std::string> words(const std::string& command);

}  // namespace nook::test
