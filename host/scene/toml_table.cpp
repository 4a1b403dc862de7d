#include "scene/toml_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace nook {

void fail_at(const std::string& file, const toml::source_region& where, const std::string& message) {
  // Messages quote the file's words, which may hold line breaks, or be long.
  std::string line = message.substr(0, 400);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  throw Error(ExitCode::scene, fmt::format("{}:{}:{}: {}", file, where.begin.line, where.begin.column, line));
}

bool TomlTable::boolean(std::string_view key, bool value) {
  const toml::node* node = find(key);
  if (!node) return value;
  if (!node->is_boolean()) wrong(*node, key, "true or false");
  return **node->as_boolean();
}

double TomlTable::number(std::string_view key, double value, double lo, double hi, const char* what,
                         bool open) {
  const toml::node* node = find(key);
  if (!node) return value;
  const auto found = node->is_number() ? node->value<double>() : std::nullopt;
  // As a float, which is what it becomes: 179.9999999 is 180 then.
  const double rounded = found ? double(float(*found)) : 0;
  if (!found || !std::isfinite(rounded) || *found < lo || *found > hi ||
      (open && (rounded <= lo || rounded >= hi)))
    wrong(*node, key, what);
  return *found;
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t value, std::int64_t lo, std::int64_t hi) {
  const toml::node* node = find(key);
  if (!node) return value;
  const toml::value<std::int64_t>* found = node->as_integer();
  if (!found || **found < lo || **found > hi)
    wrong(*node, key, fmt::format("an integer from {} to {}", lo, hi));
  return **found;
}

std::string TomlTable::text(std::string_view key, std::string value) {
  const toml::node* node = find(key);
  if (!node) return value;
  if (!node->is_string()) wrong(*node, key, "a string");
  return **node->as_string();
}

vec3 TomlTable::point(std::string_view key, vec3 value) {
  const toml::node* node = find(key);
  if (!node) return value;
  const toml::array* array = node->as_array();
  if (!array || array->size() != 3) wrong(*node, key, "three numbers");
  for (std::size_t i = 0; i < 3; ++i) {
    const toml::node& element = *array->get(i);
    const auto found = element.is_number() ? element.value<double>() : std::nullopt;
    if (!found || !std::isfinite(float(*found))) wrong(element, key, "three finite numbers");
    value[int(i)] = float(*found);
  }
  return value;
}

DistanceLimit TomlTable::distance(std::string_view key, DistanceLimit value) {
  const toml::node* node = find(key);
  if (!node) return value;
  if (node->is_string()) {
    if (const auto limit = parse_distance_limit(**node->as_string());
        limit && limit->kind != DistanceLimit::Kind::value)
      return *limit;
  } else if (const auto found = node->is_number() ? node->value<double>() : std::nullopt;
             found && *found >= 0 && std::isfinite(float(*found))) {
    return {DistanceLimit::Kind::value, float(*found)};
  }
  wrong(*node, key, "\"auto\", \"none\" or a distance of at least 0");
}

void TomlTable::finish() const {
  if (!table_) return;
  for (const auto& [key, node] : *table_) {
    if (std::find(asked_.begin(), asked_.end(), key.str()) != asked_.end()) continue;
    fail_at(file_, key.source(),
            fmt::format("unknown key '{}' in {}{}", key.str(), title_, suggestion(key.str(), asked_)));
  }
}

const toml::node* TomlTable::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  return table_ ? table_->get(key) : nullptr;
}

void TomlTable::wrong(const toml::node& node, std::string_view key, const std::string& expected) const {
  fail_at(file_, node.source(), fmt::format("{} must be {}", key, expected));
}

void TomlTable::missing(std::string_view key) const {
  const std::string message = fmt::format("{} is missing in {}", key, title_);
  if (table_) fail_at(file_, table_->source(), message);
  throw Error(ExitCode::scene, fmt::format("{}: {}", file_, message));
}

void TomlTable::unknown_value(const toml::node& node, std::string_view key, std::string_view word,
                              const std::vector<std::string_view>& known) const {
  std::string hint = suggestion(word, known);
  if (hint.empty()) hint = fmt::format(", known: {}", fmt::join(known, ", "));
  fail_at(file_, node.source(), fmt::format("unknown {} '{}'{}", key, word, hint));
}

}  // namespace nook
