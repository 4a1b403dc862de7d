#include "scene/help_text.hpp"

#include <fmt/format.h>

#include <regex>

namespace nook {

std::string help_text(const KeyInfo& key) {
  static const std::regex reference("; see \\[[^\\]]*\\]\\([^)]*\\)"), mark("`| \\+(?=[,:; ]|$)");
  std::string text(key.help);
  text = std::regex_replace(std::regex_replace(text, reference, ""), mark, "");
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = char(text.front() - 'a' + 'A');
  if (key.readers.contains(EffectKind::ro) != key.readers.contains(EffectKind::ao))
    text = fmt::format("{}: {}", key.readers.contains(EffectKind::ro) ? "ro" : "ao", text);
  if (key.readers == EffectKinds{EffectKind::ssao}) text = fmt::format("ssao: {}", text);
  if (key.domain.form == Domain::Form::boolean) return text;
  return fmt::format("{} ({})", text, expected(key.domain));
}

}  // namespace nook
