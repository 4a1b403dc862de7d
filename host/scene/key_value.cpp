#include "scene/key_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scene/names.hpp"

namespace nook {
namespace {

// Powers of ten beyond 1e4 as such.
std::string bound(double value) {
  const double exponent = value > 0 ? std::log10(value) : 0;
  if (std::abs(exponent) >= 4 && exponent == std::round(exponent)) return fmt::format("1e{:.0f}", exponent);
  return fmt::format("{}", value);
}

std::string range_text(const Domain& d) {
  // Bounds that only keep arithmetic finite are not worth a word.
  const bool low = d.lo > -1e30, high = d.hi<1e30, tiny = d.lo> 0 && d.lo <= 1e-30;
  std::string text;
  if (low && high && !d.above && !d.below) return fmt::format("from {} to {}", bound(d.lo), bound(d.hi));
  if (low)
    text = d.above || tiny ? fmt::format("above {}", tiny ? "0" : bound(d.lo))
                           : fmt::format("of at least {}", bound(d.lo));
  if (high) text += fmt::format("{}{} {}", low ? " and " : "", d.below ? "below" : "up to", bound(d.hi));
  return text;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + '"';
}

struct TomlText {
  std::string operator()(std::monostate) const { return "none"; }
  std::string operator()(bool v) const { return v ? "true" : "false"; }
  std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
  std::string operator()(float v) const { return fmt::format("{}", v); }
  std::string operator()(double v) const { return fmt::format("{}", v); }
  std::string operator()(const std::string& v) const { return quoted(v); }
  std::string operator()(const vec3& v) const { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
  std::string operator()(const dvec3& v) const { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
  std::string operator()(const PixelRect& v) const {
    return fmt::format("[{}, {}, {}, {}]", v.x0, v.x1, v.y0, v.y1);
  }
  std::string operator()(const std::vector<std::string>& v) const {
    std::vector<std::string> strings;
    for (const std::string& text : v) strings.push_back(quoted(text));
    return fmt::format("[{}]", fmt::join(strings, ", "));
  }
};

template <class T>
std::optional<T> whole_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || stop != end) return std::nullopt;
  return value;
}

// "x", "y", or "z"
std::string or_words(const Domain& d) {
  std::string text;
  for (const std::string_view word : d.words)
    text += fmt::format("{}\"{}\"", word == d.words.back() ? ", or " : ", ", word);
  return text;
}

}  // namespace

std::string expected(const Domain& d) {
  switch (d.form) {
    case Domain::Form::boolean:
      return "true or false";
    case Domain::Form::integer:
      return fmt::format("an integer from {:.0f} to {:.0f}", d.lo, d.hi) + or_words(d);
    case Domain::Form::number: {
      std::string text(d.noun);
      const std::string range = range_text(d);
      if (!range.empty()) text += (text.empty() ? "" : " ") + range;
      if (!range.empty() && !d.unit.empty()) text += fmt::format(" {}", d.unit);
      return text + or_words(d);
    }
    case Domain::Form::point:
      return "three finite numbers" + or_words(d);
    case Domain::Form::scale:
      return "a number other than 0, or three";
    case Domain::Form::choice:
      return fmt::format("{}", fmt::join(d.words, ", "));
    case Domain::Form::crop:
      return "four integers x0, x1, y0, y1";
    case Domain::Form::view:
      return fmt::format("{} or \"AZIMUTH,ELEVATION\" in degrees", fmt::join(d.words, ", "));
    case Domain::Form::color:
      return fmt::format("{} or \"#rrggbb\"", fmt::join(d.words, ", "));
    default:
      return std::string(d.noun);
  }
}

bool belongs(const Domain& d, double number) {
  const double rounded = double(float(number));
  return std::isfinite(rounded) && number >= d.lo && number <= d.hi && !(d.above && rounded <= d.lo) &&
         !(d.below && rounded >= d.hi);
}

std::string toml_text(const KeyValue& value) {
  return std::visit(TomlText(), value);
}

std::string plain_text(const KeyValue& value) {
  const std::string* word = std::get_if<std::string>(&value);
  return word ? *word : toml_text(value);
}

std::optional<KeyValue> parse_value(const std::string& text, const Domain& domain) {
  using Form = Domain::Form;
  if (domain.form == Form::point) {
    const auto point = parse_point(text);
    return point ? std::optional<KeyValue>(*point) : std::nullopt;
  }
  if (domain.form == Form::view) {
    const auto view = parse_view(text);
    return view ? std::optional<KeyValue>(to_string(*view)) : std::nullopt;
  }
  if (domain.form == Form::color) {
    const auto color = parse_background(text);
    return color ? std::optional<KeyValue>(to_string(*color)) : std::nullopt;
  }
  const bool is_word = std::find(domain.words.begin(), domain.words.end(), text) != domain.words.end();
  if (is_word || domain.form == Form::text) return text;
  if (domain.form == Form::boolean && (text == "true" || text == "false")) return text == "true";
  if (domain.form == Form::integer) {
    const auto value = whole_number<std::int64_t>(text);
    if (value && double(*value) >= domain.lo && double(*value) <= domain.hi) return *value;
  } else if (domain.form == Form::number) {
    const auto value = whole_number<double>(text);
    if (value && belongs(domain, *value)) return *value;
  }
  return std::nullopt;
}

std::string why_not(const std::string& text, const Domain& domain) {
  if (domain.form != Domain::Form::choice) return fmt::format("'{}' is not {}", text, expected(domain));
  std::string hint = suggestion(text, domain.words);
  if (hint.empty()) hint = fmt::format(", known: {}", fmt::join(domain.words, ", "));
  return fmt::format("unknown value '{}'{}", text, hint);
}

}  // namespace nook
