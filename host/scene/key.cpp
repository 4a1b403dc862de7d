#include "scene/key.hpp"

#include <algorithm>

namespace nook {

std::string KeyInfo::variable() const {
  std::string text(flag);
  if (text.empty()) return text;
  text = "NOOK" + text.substr(1);
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c == '-' ? '_' : c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
  });
  return text;
}

}  // namespace nook
