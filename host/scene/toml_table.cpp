#include "scene/toml_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"

namespace nook {
namespace {

bool one_of(std::span<const std::string_view> words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::optional<double> number_of(const toml::node& node) {
  return node.is_number() ? node.value<double>() : std::nullopt;
}

// Three numbers that are finite as floats, too. On failure `fault` is the element that is none.
std::optional<KeyValue> point_of(const toml::node& node, const toml::node*& fault) {
  const toml::array* array = node.as_array();
  if (!array || array->size() != 3) return std::nullopt;
  dvec3 point(0);
  for (std::size_t i = 0; i < 3; ++i) {
    fault = array->get(i);
    const auto found = number_of(*fault);
    if (!found || !std::isfinite(float(*found))) return std::nullopt;
    point[int(i)] = *found;
  }
  return point;
}

std::optional<KeyValue> scale_of(const toml::node& node, const toml::node*& fault) {
  const auto one = number_of(node);
  const auto value = one && std::isfinite(float(*one)) ? dvec3(*one) : point_of(node, fault);
  const dvec3* scale = value ? std::get_if<dvec3>(&*value) : nullptr;
  if (scale && (float(scale->x) == 0 || float(scale->y) == 0 || float(scale->z) == 0)) {
    fault = &node;
    return std::nullopt;
  }
  return value;
}

// A list of names that are not empty, or a word: of `words`, or any if there are none.
std::optional<KeyValue> names_of_node(const toml::node& node, const Domain& domain,
                                      const toml::node*& fault) {
  if (node.is_string()) {
    const std::string word = **node.as_string();
    if (word.empty() || (!domain.words.empty() && !one_of(domain.words, word))) return std::nullopt;
    return word;
  }
  const toml::array* list = node.as_array();
  if (!list || list->empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const toml::node& name : *list) {
    fault = &name;
    if (!name.is_string() || (*name.as_string())->empty()) return std::nullopt;
    names.push_back(**name.as_string());
  }
  return names;
}

std::optional<KeyValue> crop_of(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (!array || array->size() != 4) return std::nullopt;
  std::array<int, 4> edges{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto* edge = array->get(i)->as_integer();
    if (!edge || **edge < 0 || **edge > 65535) return std::nullopt;
    edges[i] = int(**edge);
  }
  return PixelRect{edges[0], edges[2], edges[1], edges[3]};
}

// On failure `fault` is the node to point to.
std::optional<KeyValue> value_of_node(const toml::node& node, const Domain& domain,
                                      const toml::node*& fault) {
  switch (domain.form) {
    case Domain::Form::boolean:
      return node.is_boolean() ? std::optional<KeyValue>(**node.as_boolean()) : std::nullopt;
    case Domain::Form::integer: {
      if (node.is_string() && one_of(domain.words, **node.as_string())) return **node.as_string();
      const toml::value<std::int64_t>* found = node.as_integer();
      if (!found || double(**found) < domain.lo || double(**found) > domain.hi) return std::nullopt;
      return **found;
    }
    case Domain::Form::number: {
      if (node.is_string() && one_of(domain.words, **node.as_string())) return **node.as_string();
      const auto found = number_of(node);
      return found && belongs(domain, *found) ? std::optional<KeyValue>(*found) : std::nullopt;
    }
    case Domain::Form::point:
      if (node.is_string() && one_of(domain.words, **node.as_string()))
        return parse_value(**node.as_string(), domain);
      return point_of(node, fault);
    case Domain::Form::view:
    case Domain::Form::color:
      return node.is_string() ? parse_value(**node.as_string(), domain) : std::nullopt;
    case Domain::Form::scale:
      return scale_of(node, fault);
    case Domain::Form::text:
      return node.is_string() && !(*node.as_string())->empty() ? std::optional<KeyValue>(**node.as_string())
                                                               : std::nullopt;
    case Domain::Form::names:
    case Domain::Form::files:
      return names_of_node(node, domain, fault);
    case Domain::Form::crop:
      return crop_of(node);
    default:
      return std::nullopt;
  }
}

}  // namespace

void fail_at(const std::string& file, const toml::source_region& where, const std::string& message) {
  // Messages quote the file's words, which may hold line breaks, or be long.
  std::string line = message.substr(0, 400);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  throw Error(ErrorKind::scene, Place{file, where.begin.line, where.begin.column}, line);
}

std::optional<KeyValue> TomlTable::read(const KeyInfo& key) {
  const toml::node* node = find(key.name);
  if (!node) return std::nullopt;
  if (key.domain.form == Domain::Form::choice && node->is_string()) {
    const std::string& word = **node->as_string();
    if (!one_of(key.domain.words, word)) unknown_value(*node, key.name, word, key.domain.words);
    return word;
  }
  const toml::node* fault = node;
  if (auto value = value_of_node(*node, key.domain, fault)) return value;
  wrong(*fault, key.name, key.domain.form == Domain::Form::choice ? "a string" : expected(key.domain));
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
  throw Error(ErrorKind::scene, Place{file_}, message);
}

void TomlTable::unknown_value(const toml::node& node, std::string_view key, std::string_view word,
                              std::span<const std::string_view> known) const {
  std::string hint = suggestion(word, known);
  if (hint.empty()) hint = fmt::format(", known: {}", fmt::join(known, ", "));
  fail_at(file_, node.source(), fmt::format("unknown {} '{}'{}", key, word, hint));
}

}  // namespace nook
