#include "mesh/mtl_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "mesh/mesh_text.hpp"
#include "mesh/obj_text.hpp"
#include "mesh/words.hpp"

namespace nook {
namespace {

// The finite number that `text` begins with, which is then left behind it.
std::optional<float> take_number(std::string_view& text) {
  std::string_view rest = text;
  double value = 0;
  if (const std::string_view word = next_word(rest); word.empty() || !read_number(word, value)) return {};
  if (!std::isfinite(float(value))) return {};
  text = rest;
  return float(value);
}

bool all_zero(std::string_view values) {
  const std::optional<float> first = take_number(values);
  bool zero = first == 0.0f;
  for (std::optional<float> next = take_number(values); next; next = take_number(values)) zero &= *next == 0;
  return zero;
}

// -o and -s take one to three numbers: u, v, w.
vec2 take_pair(std::string_view& text, vec2 value) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<float> number = take_number(text);
    if (!number) break;
    if (axis < 2) value[axis] = *number;
  }
  return value;
}

// What stands before a map's name. An option of an unknown name has one value.
void take_options(std::string_view& text, MapLookup& map) {
  for (;;) {
    text = trimmed(text);
    std::string_view rest = text;
    const std::string option = lower(next_word(rest));
    if (option.size() < 2 || option[0] != '-' || !std::isalpha(static_cast<unsigned char>(option[1]))) return;
    if (trimmed(rest).empty()) return;  // a file's name after all
    text = rest;
    if (option == "-s") {
      map.scale = take_pair(text, vec2(1));
    } else if (option == "-o") {
      map.offset = take_pair(text, vec2(0));
    } else if (option == "-t") {
      take_pair(text, vec2(0));
    } else if (option == "-mm") {
      map.base = take_number(text).value_or(0.0f);
      map.gain = take_number(text).value_or(1.0f);
    } else {
      const std::string value = lower(next_word(text));
      if (option == "-imfchan" && !value.empty()) map.channel = value[0];
      if (option == "-clamp") map.clamp = value == "on";
    }
  }
}

std::string without_comment(std::string_view text) {
  for (std::size_t i = 1; i < text.size(); ++i)
    if (text[i] == '#' && is_blank(text[i - 1])) return std::string(trimmed(text.substr(0, i)));
  return std::string(text);
}

class MtlReader {
 public:
  explicit MtlReader(const std::filesystem::path& path) : path_(path) {}

  void read(std::string_view statement, std::size_t line) {
    std::string_view rest = statement;
    const std::string keyword = lower(next_word(rest));
    rest = trimmed(rest);
    if (keyword == "newmtl") {
      finish();
      found_.emplace_back().material.name = rest;
    } else if (found_.empty()) {
      return;
    } else if (keyword == "ns") {
      exponent(rest, line);
    } else if (keyword == "ks") {
      black_ = all_zero(rest);
    } else if (keyword == "map_d") {
      Material& material = found_.back().material;
      material.map = {};
      take_options(rest, material.map);
      material.opacity_map = map_file(std::string(rest));
    }
  }

  std::vector<MtlMaterial> done() {
    finish();
    return std::move(found_);
  }

 private:
  void exponent(std::string_view text, std::size_t line) {
    double value = -1;
    const std::string_view word = next_word(text);
    const bool good =
        !word.empty() && read_number(word, value) && value >= 0 && value <= 1e7 && next_word(text).empty();
    MtlMaterial& found = found_.back();
    found.material.phong_exponent = good ? float(value) : -1.0f;
    found.fault = good ? "" : fmt::format("{}:{}: Ns must be a number from 0 to 1e7", path_.string(), line);
  }

  void finish() {
    if (black_ && !found_.empty()) {
      found_.back().material.phong_exponent = -1;
      found_.back().fault.clear();
    }
    black_ = false;
  }

  // Where it would have been if it is not there: for the message.
  std::string map_file(const std::string& name) {
    if (name.empty()) return "";
    const std::filesystem::path folder = path_.parent_path();
    for (const std::string& each : {name, without_comment(name)})
      if (const std::filesystem::path file = find_beside(folder, each); !file.empty()) return file.string();
    std::string missing = without_comment(name);
    std::replace(missing.begin(), missing.end(), '\\', '/');
    return (folder / missing).string();
  }

  const std::filesystem::path& path_;
  std::vector<MtlMaterial> found_;
  bool black_ = false;
};

// A file of the folder by a name of any case.
std::filesystem::path of_any_case(const std::filesystem::path& folder, const std::string& name) {
  std::error_code code;
  const std::string wanted = lower(name);
  for (std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, code), end;
       !code && entry != end; entry.increment(code)) {
    const std::filesystem::path file = entry->path().filename();
    if (lower(file.string()) == wanted && std::filesystem::is_regular_file(folder / file, code))
      return folder / file;
  }
  return {};
}

}  // namespace

std::filesystem::path find_beside(const std::filesystem::path& folder, std::string name) {
  const auto file = [&](const std::string& each) {
    std::error_code code;
    return !each.empty() && std::filesystem::is_regular_file(folder / each, code) ? folder / each
                                                                                  : std::filesystem::path();
  };
  std::filesystem::path found = file(name);
  if (!found.empty()) return found;
  if (name.size() > 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (name[i] != '\\' || i + 1 == name.size() || name[i + 1] != ' ') plain += name[i];
  if (found = file(plain); !found.empty()) return found;
  std::replace(plain.begin(), plain.end(), '\\', '/');
  if (found = file(plain); !found.empty()) return found;
  const std::string last = plain.substr(plain.rfind('/') + 1);
  if (last.empty()) return {};
  found = file(last);
  return found.empty() ? of_any_case(folder, last) : found;
}

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  MtlReader reader(path);
  for_each_statement(without_byte_order_mark(bytes, path), [&](std::string_view statement, std::size_t line) {
    reader.read(statement, line);
    return true;
  });
  return reader.done();
}

}  // namespace nook
