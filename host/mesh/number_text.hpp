#pragma once

#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>

namespace nook {

/// Reads a whole word as a number: "1", "+1.", "-.5e+10", "nan", "-inf". One that is too large is infinite,
/// one that is too small 0. False: the word is none.
inline bool read_number(const char* begin, const char* end, double& value) {
  if (begin != end && *begin == '+' && begin + 1 != end && begin[1] != '-' && begin[1] != '+') ++begin;
  const auto [stop, code] = std::from_chars(begin, end, value);
  if (code == std::errc::invalid_argument || stop != end) return false;
  if (code == std::errc::result_out_of_range) value = std::strtod(std::string(begin, end).c_str(), nullptr);
  return true;
}

inline bool read_number(std::string_view word, double& value) {
  return read_number(word.data(), word.data() + word.size(), value);
}

}  // namespace nook
