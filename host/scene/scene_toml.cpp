#include "scene/scene_toml.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

[[noreturn]] void fail(const std::string& file, const toml::source_region& where, const std::string& message) {
  throw Error(ExitCode::scene, fmt::format("{}:{}:{}: {}", file, where.begin.line, where.begin.column, message));
}

/// One TOML table whose every key must be asked for: finish() rejects those that nobody did.
class Table {
 public:
  Table(const std::string& file, std::string name, const toml::table* table) : file_(file), name_(std::move(name)), table_(table) {}

  explicit operator bool() const { return table_ != nullptr; }
  bool has(std::string_view key) const { return table_ && table_->contains(key); }

  bool boolean(std::string_view key, bool value) {
    const toml::node* node = find(key);
    if (!node) return value;
    if (!node->is_boolean()) wrong(*node, key, "true or false");
    return **node->as_boolean();
  }

  double number(std::string_view key, double value, double lo, double hi, const char* what, bool open = false) {
    const toml::node* node = find(key);
    if (!node) return value;
    const auto found = node->is_number() ? node->value<double>() : std::nullopt;
    if (!found || !std::isfinite(*found) || *found < lo || *found > hi || (open && (*found == lo || *found == hi)))
      wrong(*node, key, what);
    return *found;
  }

  std::int64_t integer(std::string_view key, std::int64_t value, std::int64_t lo, std::int64_t hi) {
    const toml::node* node = find(key);
    if (!node) return value;
    const toml::value<std::int64_t>* found = node->as_integer();
    if (!found || **found < lo || **found > hi) wrong(*node, key, fmt::format("an integer from {} to {}", lo, hi));
    return **found;
  }

  std::string text(std::string_view key, std::string value) {
    const toml::node* node = find(key);
    if (!node) return value;
    if (!node->is_string()) wrong(*node, key, "a string");
    return **node->as_string();
  }

  vec3 point(std::string_view key, vec3 value) {
    const toml::node* node = find(key);
    if (!node) return value;
    const toml::array* array = node->as_array();
    if (!array || array->size() != 3) wrong(*node, key, "three numbers");
    for (std::size_t i = 0; i < 3; ++i) {
      const toml::node& element = *array->get(i);
      const auto found = element.is_number() ? element.value<double>() : std::nullopt;
      if (!found || !std::isfinite(float(*found))) wrong(element, key, "three finite numbers");
      value[int(i)] = float(*found);
    }
    return value;
  }

  template <class T>
  T choice(std::string_view key, T value, NameTable<T> names) {
    const toml::node* node = find(key);
    if (!node) return value;
    const std::string word = text(key, "");
    if (const auto found = value_of(names, word)) return *found;
    std::vector<std::string_view> known;
    for (const auto& entry : names) known.push_back(entry.first);
    fail(file_, node->source(), fmt::format("unknown {} '{}'{}", key, word, known_values(word, known)));
  }

  DistanceLimit distance(std::string_view key, DistanceLimit value) {
    const toml::node* node = find(key);
    if (!node) return value;
    if (node->is_string()) {
      if (const auto limit = parse_distance_limit(**node->as_string()); limit && limit->kind != DistanceLimit::Kind::value) return *limit;
    } else if (const auto found = node->is_number() ? node->value<double>() : std::nullopt; found && *found >= 0 && std::isfinite(float(*found))) {
      return {DistanceLimit::Kind::value, float(*found)};
    }
    wrong(*node, key, "\"auto\", \"none\" or a distance of at least 0");
  }

  void finish() const {
    if (!table_) return;
    for (const auto& [key, node] : *table_) {
      if (std::find(asked_.begin(), asked_.end(), key.str()) != asked_.end()) continue;
      fail(file_, key.source(), fmt::format("unknown key '{}' in [{}]{}", key.str(), name_, suggestion(key.str(), asked_)));
    }
  }

  const toml::node* find(std::string_view key) {
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
    return table_ ? table_->get(key) : nullptr;
  }

  [[noreturn]] void wrong(const toml::node& node, std::string_view key, const std::string& expected) const {
    fail(file_, node.source(), fmt::format("{} must be {}", key, expected));
  }

 private:
  static std::string known_values(std::string_view word, const std::vector<std::string_view>& known) {
    std::string hint = suggestion(word, known);
    return hint.empty() ? fmt::format(", known: {}", fmt::join(known, ", ")) : hint;
  }

  const std::string& file_;
  std::string name_;
  const toml::table* table_;
  std::vector<std::string_view> asked_;
};

// The course's other assignments have more types; these are the ones of its third, and what nook adds.
EffectKind read_type(Table& renderer, const std::string& file, bool realtime) {
  const toml::node* node = renderer.find("type");
  const EffectKind kind = renderer.choice<EffectKind>("type", realtime ? EffectKind::ssao : EffectKind::ao, effect_names);
  if (node && realtime && kind != EffectKind::ssao)
    fail(file, node->source(), fmt::format("realtime = true renders type \"ssao\", not \"{}\"", name_of(kind)));
  return kind;
}

Sampling read_sampling(Table& renderer, const std::string& file, EffectKind kind) {
  const toml::node* node = renderer.find("sampling_type");
  const Sampling fallback = kind == EffectKind::ro ? Sampling::lobe : Sampling::cosine;
  const Sampling sampling = renderer.choice<Sampling>("sampling_type", fallback, sampling_names);
  if (node && kind != EffectKind::ro && (sampling == Sampling::lobe || sampling == Sampling::mixture))
    fail(file, node->source(), fmt::format("sampling_type \"{}\" needs type \"ro\"", name_of(sampling)));
  return sampling;
}

SsaoSettings read_ssao(Table& renderer) {
  SsaoSettings ssao;
  ssao.method = renderer.choice<SsaoSettings::Method>("method", ssao.method, ssao_method_names);
  if (renderer.has("quality"))
    ssao.quality = renderer.choice<SsaoSettings::Quality>("quality", SsaoSettings::Quality::real_time, ssao_quality_names);
  else
    renderer.find("quality");
  if (const toml::node* node = renderer.find("radius"); node && node->is_string() && node->value_or("") == std::string("auto"))
    ssao.radius = 0;
  else
    ssao.radius = float(renderer.number("radius", ssao.radius, 0, 1e30, "a radius above 0, or \"auto\"", true));
  ssao.bias = float(renderer.number("bias", ssao.bias, 0, 1e30, "a distance of at least 0"));
  ssao.samples = int(renderer.integer("samples", ssao.samples, 1, 32));
  ssao.range_check = renderer.boolean("range_check", ssao.range_check);
  return ssao;
}

void read_exponent(Table& renderer, Effect& effect) {
  if (const toml::node* node = renderer.find("exponent"); node && node->is_string()) {
    if (node->value_or("") != std::string("material")) renderer.wrong(*node, "exponent", "a number from 0 to 1e7, or \"material\"");
    effect.exponent_of_material = true;
    return;
  }
  effect.exponent = float(renderer.number("exponent", effect.exponent, 0, 1e7, "a number from 0 to 1e7, or \"material\""));
}

void read_renderer(Table& renderer, const std::string& file, Scene& scene) {
  scene.realtime = renderer.boolean("realtime", false);
  Effect effect;
  effect.kind = read_type(renderer, file, scene.realtime);
  effect.sampling = read_sampling(renderer, file, effect.kind);
  if (effect.kind == EffectKind::ro) effect.max_distance.kind = DistanceLimit::Kind::none;
  effect.max_distance = renderer.distance("max_distance", effect.max_distance);
  read_exponent(renderer, effect);
  effect.ssao = read_ssao(renderer);
  scene.effects = {effect};
  scene.spp = std::uint32_t(renderer.integer("spp", 1, 1, 1 << 26));
  scene.directions = std::uint32_t(renderer.integer("directions", 1, 1, 1 << 26));
  scene.sampler = renderer.choice<Sampler>("sampler", Sampler::sobol, sampler_names);
  scene.seed = std::uint32_t(renderer.integer("seed", 0, 0, 0xffffffffLL));
  static constexpr std::pair<std::string_view, bool> compat_names[] = {{"tinyrender", true}, {"none", false}};
  scene.compat_tinyrender = renderer.choice<bool>("compat", false, compat_names);
}

void read_film(Table& film, Scene& scene) {
  scene.width = int(film.integer("width", scene.width, 1, 65535));
  scene.height = int(film.integer("height", scene.height, 1, 65535));
  const toml::node* node = film.find("crop");
  if (!node) return;
  const toml::array* array = node->as_array();
  std::array<int, 4> edges{};
  bool valid = array && array->size() == 4;
  for (std::size_t i = 0; valid && i < 4; ++i) {
    const auto* edge = array->get(i)->as_integer();
    valid = edge && **edge >= 0 && **edge <= 65535;
    if (valid) edges[i] = int(**edge);
  }
  if (!valid) film.wrong(*node, "crop", "four integers x0, x1, y0, y1");
  scene.crop = PixelRect{edges[0], edges[2], edges[1], edges[3]};
}

toml::table parse(const std::filesystem::path& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) throw Error(ExitCode::scene, fmt::format("{}: no such file", path.string()));
  if (!std::filesystem::is_regular_file(status)) throw Error(ExitCode::scene, fmt::format("{}: not a regular file", path.string()));
  constexpr std::uintmax_t largest = 16u << 20;
  if (std::filesystem::file_size(path, code) > largest)
    throw Error(ExitCode::scene, fmt::format("{}: too large for a scene file (over 16 MiB)", path.string()));
  try {
    return toml::parse_file(path.string());
  } catch (const toml::parse_error& e) {
    if (e.source().begin.line == 0) throw Error(ExitCode::scene, fmt::format("{}: {}", path.string(), e.description()));
    fail(path.string(), e.source(), std::string(e.description()));
  }
}

}  // namespace

Scene load_scene(const std::filesystem::path& path) {
  const toml::table root = parse(path);
  const std::string file = path.string();
  Table top(file, "scene", &root);
  auto table = [&](const char* key) {
    const toml::node* node = top.find(key);
    if (node && !node->is_table()) fail(file, node->source(), fmt::format("{} must be a table: [{}]", key, key));
    return Table(file, key, node ? node->as_table() : nullptr);
  };
  Table input = table("input"), camera = table("camera"), film = table("film"), renderer = table("renderer");

  Scene scene;
  scene.file = path;
  if (!input.has("objfile")) throw Error(ExitCode::scene, fmt::format("{}: objfile is missing in [input]", file));
  scene.mesh_file = path.parent_path() / input.text("objfile", "");
  scene.camera.fov = float(camera.number("fov", scene.camera.fov, 0, 180, "an angle above 0 and below 180 degrees", true));
  scene.camera.eye = camera.point("eye", scene.camera.eye);
  scene.camera.at = camera.point("at", scene.camera.at);
  scene.camera.up = camera.point("up", scene.camera.up);
  read_film(film, scene);
  read_renderer(renderer, file, scene);
  for (const Table* each : {&top, &input, &camera, &film, &renderer}) each->finish();
  return scene;
}

Scene scene_of_mesh(const std::filesystem::path& mesh_file) {
  Scene scene;
  scene.file = mesh_file;
  scene.mesh_file = mesh_file;
  scene.automatic_camera = true;
  scene.effects = {Effect{}};
  scene.spp = 16;
  return scene;
}

void validate(const Scene& scene) {
  const std::string file = scene.file.string();
  const dvec3 view = dvec3(scene.camera.at) - dvec3(scene.camera.eye), up(scene.camera.up);
  if (!scene.automatic_camera) {
    if (glm::length(view) == 0) throw Error(ExitCode::scene, fmt::format("{}: the camera's eye and at are the same point", file));
    if (glm::length(up) == 0) throw Error(ExitCode::scene, fmt::format("{}: the camera's up is zero", file));
    if (glm::length(glm::cross(glm::normalize(view), glm::normalize(up))) < 1e-6)
      throw Error(ExitCode::scene, fmt::format("{}: the camera's up is parallel to its view direction", file));
  }
  if (scene.crop) {
    const PixelRect& c = *scene.crop;
    if (c.x0 >= c.x1 || c.y0 >= c.y1 || c.x1 > scene.width || c.y1 > scene.height)
      throw Error(ExitCode::scene, fmt::format("{}: the crop {},{},{},{} (x0,x1,y0,y1) is empty or outside the {}x{} film", file, c.x0,
                                               c.x1, c.y0, c.y1, scene.width, scene.height));
  }
}

}  // namespace nook
