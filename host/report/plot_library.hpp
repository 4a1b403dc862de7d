#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace nook {

/// The library that draws a page's plots: Chart.js 3 (MIT licence), as Debian's libjs-chart.js has it. It
/// goes into the page, notices included, so that the page needs nothing else.
struct PlotLibrary {
  std::string script;   ///< JavaScript, safe inside an HTML script element; empty: the page shows tables
  std::string licence;  ///< its copyright file; may be empty, the script's own notice stays in any case
};

/// The file that Debian's package installs.
inline constexpr const char* debian_chart_js = "/usr/share/javascript/chart.js/chart.min.js";

/// From `file`, which must be there, or else from debian_chart_js, which need not. Throws Error(scene) if
/// `file` cannot be read or is not Chart.js.
PlotLibrary load_plot_library(const std::optional<std::filesystem::path>& file);

}  // namespace nook
