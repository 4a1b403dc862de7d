#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "math/types.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Throws Error(scene) "<file>:<row>:<column>: <message>".
[[noreturn]] void fail_at(const std::string& file, const toml::source_region& where,
                          const std::string& message);

/// One TOML table whose every key must be asked for: finish() rejects those that nobody did.
/// Without the table, every key has its default.
class TomlTable {
 public:
  /// title: as messages name it, e.g. "[film]".
  TomlTable(const std::string& file, std::string title, const toml::table* table)
      : file_(file), title_(std::move(title)), table_(table) {}

  explicit operator bool() const { return table_ != nullptr; }
  const std::string& file() const { return file_; }
  void set_title(std::string title) { title_ = std::move(title); }
  bool has(std::string_view key) const { return table_ && table_->contains(key); }

  bool boolean(std::string_view key, bool value);
  /// In [lo, hi], or in (lo, hi) if `open`; `what` describes the domain in the message.
  double number(std::string_view key, double value, double lo, double hi, const char* what,
                bool open = false);
  std::int64_t integer(std::string_view key, std::int64_t value, std::int64_t lo, std::int64_t hi);
  std::string text(std::string_view key, std::string value);
  vec3 point(std::string_view key, vec3 value);
  DistanceLimit distance(std::string_view key, DistanceLimit value);

  template <class T>
  T choice(std::string_view key, T value, NameTable<T> names) {
    const toml::node* node = find(key);
    if (!node) return value;
    const std::string word = text(key, "");
    if (const auto found = value_of(names, word)) return *found;
    std::vector<std::string_view> known;
    for (const auto& entry : names) known.push_back(entry.first);
    unknown_value(*node, key, word, known);
  }

  /// The key's node, null if absent. The key counts as asked for.
  const toml::node* find(std::string_view key);
  /// Throws "<key> must be <expected>" at the node.
  [[noreturn]] void wrong(const toml::node& node, std::string_view key, const std::string& expected) const;
  /// Throws "<key> is missing in <title>" at the table.
  [[noreturn]] void missing(std::string_view key) const;
  /// Throws at the first key that was not asked for.
  void finish() const;

 private:
  [[noreturn]] void unknown_value(const toml::node& node, std::string_view key, std::string_view word,
                                  const std::vector<std::string_view>& known) const;

  const std::string& file_;
  std::string title_;
  const toml::table* table_;
  std::vector<std::string_view> asked_;
};

}  // namespace nook
