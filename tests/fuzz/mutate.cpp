#include "mutate.hpp"

#include <algorithm>
#include <cctype>

namespace nook::fuzz {
namespace {

std::size_t below(std::mt19937& random, std::size_t limit) {
  return limit ? random() % limit : 0;
}

void replace_number(std::string& input, std::mt19937& random) {
  static const char* const numbers[] = {"0",           "-1",         "1",          "2147483647",
                                        "-2147483649", "4294967296", "1000000000", "99999999999999999999",
                                        "1e38",        "1e-45",      "0.1e999",    "nan"};
  const std::size_t start = below(random, input.size());
  const auto digit = std::find_if(input.begin() + std::ptrdiff_t(start), input.end(),
                                  [](unsigned char c) { return std::isdigit(c); });
  const auto end =
      std::find_if_not(digit, input.end(), [](unsigned char c) { return std::isdigit(c) || c == '.'; });
  input.replace(digit, end, numbers[below(random, std::size(numbers))]);
}

}  // namespace

std::string mutate(std::string input, const Target& target, std::mt19937& random) {
  for (std::size_t changes = 1 + below(random, 8); changes > 0; --changes) {
    const std::size_t at = below(random, input.size()),
                      length = std::min(below(random, 16), input.size() - at);
    switch (random() % 9) {
      case 0:
        if (!input.empty()) input[at] = char(input[at] ^ (1 << random() % 8));
        break;
      case 1:
        if (!input.empty()) input[at] = char(random() % 256);
        break;
      case 2:
        input.erase(at, length);
        break;
      case 3:
        input.insert(at, input.substr(at, length));
        break;
      case 4:
        input.insert(at, target.tokens[below(random, target.tokens.size())]);
        break;
      case 5:
        replace_number(input, random);
        break;
      case 6: {
        const std::string& other = target.seeds[below(random, target.seeds.size())];
        const std::size_t from = below(random, other.size());
        input.replace(at, length, other.substr(from, 32));
        break;
      }
      case 7:
        input.resize(at);
        break;
      default:
        input.insert(at, std::string(1 + below(random, 64), input.empty() ? '[' : input[at]));
    }
  }
  return input;
}

}  // namespace nook::fuzz
