#pragma once

#include <span>
#include <string>
#include <vector>

namespace nook::fuzz {

/// A reader of files that users hand in.
struct Target {
  const char* name;
  const char* file;  ///< the name of the file that holds the input; readers go by its extension
  void (*read)(const std::string& path);
  std::vector<std::string> seeds;   ///< inputs that are right, or nearly
  std::vector<std::string> tokens;  ///< words that the format knows
};

const std::vector<Target>& targets();

/// Gives `input` to the target as a file. What it may do is read it, or throw nook::Error with one line;
/// anything else that it throws comes out.
void run_once(const Target& target, const std::string& input);

}  // namespace nook::fuzz
