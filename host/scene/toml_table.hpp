#pragma once

#include <toml++/toml.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/key.hpp"

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
  const std::string& title() const { return title_; }
  void set_title(std::string title) { title_ = std::move(title); }
  bool has(std::string_view key) const { return table_ && table_->contains(key); }

  /// The key's value, which must belong to its domain; nullopt if it is absent.
  std::optional<KeyValue> read(const KeyInfo& key);

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
                                  std::span<const std::string_view> known) const;

  const std::string& file_;
  std::string title_;
  const toml::table* table_;
  std::vector<std::string_view> asked_;
};

/// Reads every key of `keys` that the table has into `owner`.
template <class Owner>
void read_keys(TomlTable& table, std::span<const Key<Owner>> keys, Owner& owner) {
  for (const Key<Owner>& key : keys)
    if (const auto value = table.read(key.info)) key.field.set(owner, *value);
}

/// Throws at the first key that was given and does not apply beside the others.
template <class Owner>
void check_use(TomlTable& table, std::span<const Key<Owner>> keys, const Owner& owner) {
  for (const Key<Owner>& key : keys)
    if (table.has(key.info.name) && !key.in_use(owner))
      fail_at(table.file(), table.find(key.info.name)->source(), std::string(key.info.needs));
}

}  // namespace nook
