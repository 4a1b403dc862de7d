// The tables of docs/scene-format.md are those of the keys' descriptions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene/effect_keys.hpp"
#include "scene/scene_keys.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

std::string values_text(const Domain& domain) {
  if (domain.form == Domain::Form::choice) return fmt::format("`{}`", fmt::join(domain.words, "`, `"));
  std::string text = expected(domain);
  if (text.find(domain.unit) == std::string::npos) text += fmt::format(", in {}", domain.unit);
  return text;
}

std::string code(const KeyValue& value) {
  return std::holds_alternative<std::monostate>(value) ? "none" : fmt::format("`{}`", toml_text(value));
}

std::string row(const KeyInfo& key, const std::string& types, const std::string& standard) {
  return fmt::format("| `{}`{} |{} {} | {} | {} |\n", key.name, key.of_nook ? " +" : "",
                     types.empty() ? "" : " " + types + " |",
                     key.default_says.empty() ? standard : std::string(key.default_says),
                     values_text(key.domain), key.help);
}

template <class Owner>
std::string table(std::span<const Key<Owner>> keys) {
  std::string text = "| key | default | values | meaning |\n|---|---|---|---|\n";
  for (const Key<Owner>& key : keys) text += row(key.info, "", code(key.field.get(Owner())));
  return text;
}

std::string table_of_effects() {
  std::string text = "| key | types | default | values | meaning |\n|---|---|---|---|---|\n";
  for (const Key<Effect>& key : effect_keys()) {
    std::string types, standard, first;
    for (const auto& [name, kind] : effect_names) {
      if (!key.info.readers.contains(kind)) continue;
      const std::string value = code(key.field.get(default_effect(kind)));
      if (types.empty()) first = standard = value;
      if (value != first) standard += fmt::format("; {} {}", name, value);
      types += fmt::format("{}{}", types.empty() ? "" : ", ", name);
    }
    text += row(key.info, key.info.readers == all_kinds ? "all" : types, standard);
  }
  return text;
}

TEST(SceneDocs, TablesAreThoseOfTheKeys) {
  const std::string docs = test::read_bytes(std::string(NOOK_SOURCE_DIR) + "/docs/scene-format.md");
  for (const std::string& expected :
       {table(input_keys()), table(instance_keys()), table(ground_keys()), table(camera_keys()),
        table(film_keys()), table(renderer_keys()), table_of_effects()})
    EXPECT_NE(docs.find(expected), std::string::npos) << "docs/scene-format.md lacks the table\n" << expected;
}

}  // namespace
}  // namespace nook
