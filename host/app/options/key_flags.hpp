#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "scene/help_text.hpp"
#include "scene/scene_keys.hpp"

namespace nook {

/// What --help calls the flag's value: INT, NUMBER or WORD.
std::string flag_type(const KeyInfo& key);

/// Adds the key's flag and variable; what they give must belong to the key's domain.
template <class T>
CLI::Option* add_key_flag(CLI::App& command, const KeyInfo& key, T& value) {
  return command.add_option(std::string(key.flag), value, help_text(key))
      ->check(
          [&key](const std::string& text) {
            return parse_value(text, key.domain) ? std::string() : why_not(text, key.domain);
          },
          "")
      ->type_name(flag_type(key))
      ->envname(key.variable());
}

}  // namespace nook
