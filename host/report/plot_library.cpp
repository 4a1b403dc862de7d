#include "report/plot_library.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "base/input_file.hpp"

namespace nook {
namespace {

constexpr const char* debian_copyright = "/usr/share/doc/libjs-chart.js/copyright";
constexpr std::uint64_t most_bytes = 16u << 20;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

PlotLibrary load_plot_library(const std::optional<std::filesystem::path>& file) {
  const std::filesystem::path path = file.value_or(debian_chart_js);
  PlotLibrary library;
  std::error_code code;
  if (!file && !std::filesystem::is_regular_file(path, code)) return library;
  if (size_of_input(path) <= most_bytes) library.script = text_of(path);
  if (library.script.find("Chart.js v3.") == std::string::npos) {
    if (!file) return {};
    throw Error(ErrorKind::scene, Place{path.string()}, "not Chart.js 3");
  }
  // "</script" would end the element; in a string or a regular expression "<\/script" is the same.
  for (std::size_t at = library.script.find("</script"); at != std::string::npos;
       at = library.script.find("</script", at + 3))
    library.script.insert(at + 1, 1, '\\');
  library.licence = text_of(debian_copyright);
  return library;
}

}  // namespace nook
