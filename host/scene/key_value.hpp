#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "math/types.hpp"
#include "scene/scene.hpp"

namespace nook {

/// What a key holds, whatever its type. monostate: nothing is set. A string is a text, one of a choice's
/// words, or a word that stands for what no number says ("auto").
using KeyValue = std::variant<std::monostate, bool, std::int64_t, float, double, std::string, vec3, dvec3,
                              PixelRect, std::vector<std::string>>;

/// The values that a key may have.
struct Domain {
  /// point: three numbers. scale: a number, or three; not 0. names: a list of names, or a word. files: a
  /// name, or a list of them. crop: x0, x1, y0, y1. view, color: parse_view(), parse_background().
  enum class Form { boolean, integer, number, point, scale, choice, text, names, files, crop, view, color };
  Form form = Form::number;
  double lo = -std::numeric_limits<double>::infinity(), hi = std::numeric_limits<double>::infinity();
  bool above = false, below = false;  ///< lo, hi themselves do not belong to it
  std::string_view noun = "a number", unit = "";
  std::span<const std::string_view> words = {};  ///< of a choice; or what may stand in a number's place
};

/// "an angle above 0 and up to 90 degrees", "a number from 0 to 1e7, or \"material\"", "true or false".
std::string expected(const Domain& domain);

/// Whether a number belongs to the domain; it is rounded to a float before, which most keys hold.
bool belongs(const Domain& domain, double number);

/// The value as a scene file has it: 0.5, "auto", [1, 2, 3], ["leaf", "stem"]. `value` holds something.
std::string toml_text(const KeyValue& value);

/// The value as reports and attributes have it: the same, without a word's quotation marks; "none" for
/// nothing.
std::string plain_text(const KeyValue& value);

/// The value that `text` of a command line names, of a boolean, integer, number, point, choice, text, view or
/// color. nullopt if it does not belong to the domain.
std::optional<KeyValue> parse_value(const std::string& text, const Domain& domain);

/// "unknown value 'cosin', did you mean 'cosine'?", or "'x' is not <expected>".
std::string why_not(const std::string& text, const Domain& domain);

}  // namespace nook
