#pragma once

#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>

namespace nook {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The next word of `text`, which is left behind it; empty: none is left, or a comment (a word that begins
/// with '#').
std::string_view next_word(std::string_view& text);

/// ASCII letters in lower case.
std::string lower(std::string_view text);

/// Whether the word is a value that is not finite as Microsoft's C library wrote it until 2015, whatever the
/// digits asked for: "1.#QNAN", "-1.#IND00", "1.#INF".
bool read_old_not_finite(std::string_view word, double& value);

/// Reads a whole word as a number: "1", "+1.", "-.5e+10", "nan", "-inf", "-1.#IND". One that is too large is
/// infinite, one that is too small 0. False: the word is none.
inline bool read_number(const char* begin, const char* end, double& value) {
  if (begin != end && *begin == '+' && begin + 1 != end && begin[1] != '-' && begin[1] != '+') ++begin;
  const auto [stop, code] = std::from_chars(begin, end, value);
  if (code == std::errc::invalid_argument) return false;
  if (stop != end) return *stop == '#' && read_old_not_finite({begin, end}, value);
  if (code == std::errc::result_out_of_range) value = std::strtod(std::string(begin, end).c_str(), nullptr);
  return true;
}

inline bool read_number(std::string_view word, double& value) {
  return read_number(word.data(), word.data() + word.size(), value);
}

}  // namespace nook
