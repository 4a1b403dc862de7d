#include "mesh/words.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

namespace nook {

bool read_old_not_finite(std::string_view word, double& value) {
  const bool negative = word.starts_with('-');
  if (negative) word.remove_prefix(1);
  if (!word.starts_with("1.#") || word.size() < 4) return false;
  word.remove_prefix(3);
  if (!std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c); })) return false;
  value = word.starts_with("INF") ? std::numeric_limits<double>::infinity()
                                  : std::numeric_limits<double>::quiet_NaN();
  if (negative) value = -value;
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view next_word(std::string_view& text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  std::size_t length = 0;
  while (length < text.size() && !is_blank(text[length])) ++length;
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return !word.empty() && word[0] == '#' ? std::string_view() : word;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return out;
}

}  // namespace nook
