#pragma once

#include <random>
#include <string>

#include "targets.hpp"

namespace nook::fuzz {

/// One to eight random changes to an input: bits flipped, bytes set, removed, repeated, exchanged for another
/// input's, words of the format put in, numbers replaced.
std::string mutate(std::string input, const Target& target, std::mt19937& random);

}  // namespace nook::fuzz
