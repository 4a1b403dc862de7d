#include "base/error.hpp"

#include <fmt/format.h>

#include <utility>

namespace nook {
namespace {

std::string message_of(const Place& place, std::string_view what) {
  if (place.file.empty()) return std::string(what);
  std::string text = place.file;
  if (place.row) text += fmt::format(":{}", place.row);
  if (place.column) text += fmt::format(":{}", place.column);
  return fmt::format("{}: {}", text, what);
}

}  // namespace

Error::Error(ErrorKind kind, Place place, std::string_view what)
    : std::runtime_error(message_of(place, what)), kind_(kind), place_(std::move(place)) {}

}  // namespace nook
