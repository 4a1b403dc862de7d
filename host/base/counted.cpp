#include "base/counted.hpp"

namespace nook {

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, 1, ' ');
  return digits;
}

std::string counted(std::uint64_t number, const std::string& word, const std::string& plural) {
  return grouped(number) + ' ' + (number == 1 ? word : plural.empty() ? word + 's' : plural);
}

}  // namespace nook
