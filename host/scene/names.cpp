#include "scene/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <vector>

namespace nook {
namespace {

// Levenshtein distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

// All of the text is a finite number.
std::optional<double> number(std::string_view text) {
  double value = 0;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(float(value)))
    return std::nullopt;
  return value;
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto value = number(text.substr(begin, end - begin));
    if (!value) return {};
    values.push_back(*value);
    begin = end + 1;
  }
  return values;
}

}  // namespace

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(word.size() / 2, 1) + 1;
  for (std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word.substr(0, 64), candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> candidates) {
  const std::string_view best = nearest(word, candidates);
  return best.empty() ? "" : fmt::format(", did you mean '{}'?", best);
}

std::optional<DistanceLimit> parse_distance_limit(const std::string& text) {
  if (text == "auto") return DistanceLimit{DistanceLimit::Kind::automatic, 0};
  if (text == "none") return DistanceLimit{DistanceLimit::Kind::none, 0};
  float value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value) || value < 0)
    return std::nullopt;
  return DistanceLimit{DistanceLimit::Kind::value, value};
}

std::string to_string(const DistanceLimit& limit) {
  switch (limit.kind) {
    case DistanceLimit::Kind::automatic:
      return "auto";
    case DistanceLimit::Kind::none:
      return "none";
    default:
      return fmt::format("{}", limit.value);
  }
}

std::optional<View> parse_view(std::string_view text) {
  if (const auto known = value_of<View>(view_names, text)) return known;
  const std::vector<double> angles = numbers(text);
  if (angles.size() != 2 || std::abs(angles[0]) > 360 || std::abs(angles[1]) > 90) return std::nullopt;
  return View{angles[0], angles[1]};
}

std::string to_string(const View& view) {
  for (const auto& [name, known] : view_names)
    if (known == view) return std::string(name);
  return fmt::format("{},{}", view.azimuth, view.elevation);
}

std::optional<Background> parse_background(std::string_view text) {
  if (const auto known = value_of<Background>(background_names, text)) return known;
  unsigned value = 0;
  if (text.size() != 7 || text.front() != '#') return std::nullopt;
  const auto [end, code] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return Background{false, std::uint8_t(value >> 16), std::uint8_t(value >> 8), std::uint8_t(value)};
}

std::string to_string(const Background& background) {
  for (const auto& [name, known] : background_names)
    if (known == background) return std::string(name);
  return fmt::format("#{:02x}{:02x}{:02x}", background.red, background.green, background.blue);
}

std::optional<dvec3> parse_point(std::string_view text) {
  if (const auto axis = value_of<Axis>(axis_names, text)) return direction_of(*axis);
  const std::vector<double> values = numbers(text);
  if (values.size() != 3) return std::nullopt;
  return dvec3(values[0], values[1], values[2]);
}

}  // namespace nook
