#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace nook {

/// fmt::print to stderr, but that a failure is nobody's: a log on a full disk or a closed terminal loses
/// lines, and no picture.
template <class... Values>
void to_stderr(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace nook
