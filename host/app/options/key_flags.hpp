#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "scene/scene_keys.hpp"

namespace nook {

/// What --help says of a key: its line of docs/scene-format.md without Markdown, and the values it may have.
std::string flag_help(const KeyInfo& key);

/// What --help calls the flag's value: INT, NUMBER or WORD.
std::string flag_type(const KeyInfo& key);

/// Adds the key's flag and variable; what they give must belong to the key's domain.
template <class T>
CLI::Option* add_key_flag(CLI::App& command, const KeyInfo& key, T& value) {
  return command.add_option(std::string(key.flag), value, flag_help(key))
      ->check(
          [&key](const std::string& text) {
            return parse_value(text, key.domain) ? std::string() : why_not(text, key.domain);
          },
          "")
      ->type_name(flag_type(key))
      ->envname(key.variable());
}

}  // namespace nook
