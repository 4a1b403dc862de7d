#include "mesh/mtl_scan.hpp"

#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <sstream>
#include <vector>

#include "base/error.hpp"

namespace nook {
namespace {

bool is_exponent(const std::string& word) {
  double value = -1;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  return code == std::errc() && end == word.data() + word.size() && value >= 0 && value <= 1e7;
}

bool is_zero(const std::string& word) {
  double value = 1;
  std::from_chars(word.data(), word.data() + word.size(), value);
  return value == 0;
}

}  // namespace

std::set<std::string> materials_with_lobe(std::string_view text, const std::string& name) {
  std::set<std::string> shiny, black;
  std::istringstream in{std::string(text)};
  std::string line, material;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    const std::vector<std::string> values{std::istream_iterator<std::string>(words), {}};
    if (key == "newmtl") {
      const std::size_t first = line.find_first_not_of(" \t", line.find("newmtl") + 6);
      material =
          first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
    } else if (key == "Ns") {
      if (values.size() != 1 || !is_exponent(values[0]))
        throw Error(ExitCode::scene, fmt::format("{}:{}: Ns must be a number from 0 to 1e7", name, number));
      shiny.insert(material);
    } else if (key == "Ks" && values.size() == 3 && is_zero(values[0]) && is_zero(values[1]) &&
               is_zero(values[2])) {
      black.insert(material);
    }
  }
  for (const std::string& dull : black) shiny.erase(dull);
  return shiny;
}

}  // namespace nook
