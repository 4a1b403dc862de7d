#include "app/commands/delivery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "scene/scene_toml.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void reject(const fs::path& config, const std::string& what) {
  throw Error(ErrorKind::scene, Place{config.string()}, what);
}

nlohmann::ordered_json parse(const fs::path& config) {
  if (size_of_input(config) > 1u << 20) reject(config, "too large for a config.json (over 1 MiB)");
  std::ifstream in(config, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    const std::string before = text.substr(0, e.byte > 0 ? e.byte - 1 : 0);
    const auto row = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column =
        before.size() - (before.rfind('\n') + 1) + 1;  // without a line break, npos + 1 is 0
    throw Error(ErrorKind::scene, Place{config.string(), std::uint64_t(row), column}, "not JSON");
  } catch (const nlohmann::json::out_of_range&) {
    reject(config, "not JSON: a number is too large");
  }
}

std::string text_of(const nlohmann::ordered_json& json, const char* key, const fs::path& config,
                    const std::string& where) {
  if (!json.contains(key)) reject(config, fmt::format("{} is missing{}", key, where));
  if (!json[key].is_string() || json[key].get<std::string>().empty())
    reject(config, fmt::format("{}{} must be a string, and not empty", key, where));
  return json[key];
}

std::uint64_t number_of(const nlohmann::ordered_json& json, const char* key, const fs::path& config) {
  if (!json.contains(key)) reject(config, fmt::format("{} is missing", key));
  if (!json[key].is_number_unsigned()) reject(config, fmt::format("{} must be a whole number", key));
  return json[key];
}

// "offline" or "realtime" of "offline/NAME.exr"; every other form is refused, so that nothing is written
// elsewhere.
std::string folder_of(const std::string& render, const fs::path& config, const std::string& where) {
  for (const std::string folder : {"offline", "realtime"}) {
    const std::string start = folder + "/";
    if (!render.starts_with(start) || !render.ends_with(".exr")) continue;
    const std::string stem = render.substr(start.size(), render.size() - start.size() - 4);
    const bool plain =
        !stem.empty() && stem[0] != '.' && stem.find_first_of("/\\'\"<>&\n") == std::string::npos;
    if (plain) return folder;
  }
  reject(config, fmt::format("render '{}'{} must be offline/NAME.exr or realtime/NAME.exr", render, where));
}

fs::path find_scene(const std::string& render, const std::string& folder,
                    const std::vector<fs::path>& folders, const fs::path& config) {
  const std::string stem = fs::path(render).stem().string();
  std::string tried;
  for (const fs::path& where : folders)
    for (const std::string& name : {stem + ".toml", stem + "_" + folder + ".toml"}) {
      std::error_code code;
      if (fs::is_regular_file(where / name, code)) return where / name;
      tried += (tried.empty() ? "" : ", ") + (where / name).string();
    }
  reject(config, fmt::format("no scene for {}: tried {}", render, tried));
}

}  // namespace

Delivery read_delivery(const fs::path& config, const std::string& student,
                       const std::vector<fs::path>& scene_folders) {
  nlohmann::ordered_json json = parse(config);
  if (!json.is_object()) reject(config, "must be an object: {...}");
  if (!student.empty()) json["firstlast"] = student;
  Delivery delivery;
  delivery.student = text_of(json, "firstlast", config, "");
  delivery.id = number_of(json, "id", config);
  delivery.course = number_of(json, "course", config);
  delivery.assignment = number_of(json, "assignment", config);
  if (!json.contains("renders") || !json["renders"].is_array() || json["renders"].empty())
    reject(config, "renders must be a list, and not empty");
  for (const auto& item : json["renders"]) {
    const std::string where = fmt::format(" in renders[{}]", delivery.entries.size());
    if (!item.is_object()) reject(config, "renders must hold objects" + where);
    DeliveryEntry entry{text_of(item, "scene", config, where), text_of(item, "render", config, where), {}};
    const std::string folder = folder_of(entry.render, config, where);
    for (const DeliveryEntry& other : delivery.entries)
      if (other.render == entry.render) reject(config, fmt::format("{} is listed twice", entry.render));
    entry.scene = find_scene(entry.render, folder, scene_folders, config);
    if (load_scene(entry.scene).realtime != (folder == "realtime"))
      reject(config, fmt::format("{} belongs into the other folder: {} says realtime = {}", entry.render,
                                 entry.scene.string(), folder == "offline"));
    delivery.entries.push_back(std::move(entry));
  }
  delivery.config = json.dump(2) + '\n';
  return delivery;
}

}  // namespace nook
