#include "app/scene_options.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "base/error.hpp"
#include "base/threads.hpp"
#include "device/pocl_folder.hpp"
#include "film/exr.hpp"
#include "mesh/load_mesh.hpp"
#include "render/plan.hpp"
#include "scene/names.hpp"
#include "scene/scene_toml.hpp"

namespace nook {
namespace {

template <class T>
T chosen(const char* flag, const std::string& word, NameTable<T> names) {
  if (const auto value = value_of(names, word)) return *value;
  std::vector<std::string_view> known;
  for (const auto& entry : names) known.push_back(entry.first);
  throw Error(ExitCode::usage,
              fmt::format("{}: unknown value '{}', known: {}", flag, word, fmt::join(known, ", ")));
}

// "800x600"
std::pair<int, int> parse_size(const std::string& text) {
  int width = 0, height = 0;
  const char* end = text.data() + text.size();
  const auto [x, first] = std::from_chars(text.data(), end, width);
  const auto [stop, second] = x < end && *x == 'x' ? std::from_chars(x + 1, end, height)
                                                   : std::from_chars_result{x, std::errc::invalid_argument};
  if (first != std::errc() || second != std::errc() || stop != end || width < 1 || height < 1 ||
      width > 65535 || height > 65535)
    throw Error(ExitCode::usage,
                fmt::format("--size: '{}' is not WIDTHxHEIGHT with 1 to 65535 pixels each", text));
  return {width, height};
}

std::string quoted_limit(const DistanceLimit& limit) {
  return limit.kind == DistanceLimit::Kind::value ? fmt::format("{}", limit.value)
                                                  : fmt::format("\"{}\"", to_string(limit));
}

// A TOML string may hold quotes and backslashes; control characters are escaped too.
std::string toml_string(const std::string& text) {
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

std::string toml_list(const std::vector<std::string>& names) {
  std::vector<std::string> strings;
  for (const std::string& name : names) strings.push_back(toml_string(name));
  return fmt::format("[{}]", fmt::join(strings, ", "));
}

// The keys of one effect.
std::string effect_toml(const Effect& e) {
  std::string out = fmt::format("type = \"{}\"\n", name_of(e.kind));
  if (is_surface(e.kind)) return out;
  if (e.kind == EffectKind::ssao) {
    out +=
        fmt::format("method = \"{}\"\nradius = {}\nbias = {}\nsamples = {}\nrange_check = {}\n",
                    name_of(e.ssao.method), e.ssao.radius > 0 ? fmt::format("{}", e.ssao.radius) : "\"auto\"",
                    e.ssao.bias, e.ssao.samples, e.ssao.range_check);
    if (e.ssao.quality) out += fmt::format("quality = \"{}\"\n", name_of(*e.ssao.quality));
    return out;
  }
  out += fmt::format("sampling_type = \"{}\"\nmax_distance = {}\n", name_of(e.sampling),
                     quoted_limit(e.max_distance));
  if (e.min_distance > 0) out += fmt::format("min_distance = {}\n", e.min_distance);
  if (e.falloff != Falloff::none) out += fmt::format("falloff = \"{}\"\n", name_of(e.falloff));
  if (e.side != Side::normal) out += fmt::format("side = \"{}\"\n", name_of(e.side));
  if (e.cone_angle < 90) out += fmt::format("cone_angle = {}\n", e.cone_angle);
  if (e.view_space) out += "space = \"view\"\n";
  if (e.only_self) out += "occluders = \"self\"\n";
  if (!e.occluders.empty()) out += fmt::format("occluders = {}\n", toml_list(e.occluders));
  if (!e.receivers.empty()) out += fmt::format("receivers = {}\n", toml_list(e.receivers));
  if (e.kind == EffectKind::ro)
    out += e.exponent_of_material ? "exponent = \"material\"\n" : fmt::format("exponent = {}\n", e.exponent);
  return out;
}

// The keys of how long to render.
std::string stop_toml(const Scene& s) {
  if (!s.stop.any()) return fmt::format("spp = {}\n", s.spp);
  std::string out;
  if (s.stop.error)
    out += fmt::format("error = {}\nconfidence = {}\nmin_spp = {}\n", *s.stop.error, s.stop.confidence,
                       s.stop.min_spp);
  if (s.stop.seconds) out += fmt::format("time = {}\n", *s.stop.seconds);
  return out + fmt::format("max_spp = {}\n", s.stop.max_spp);
}

}  // namespace

void SceneOptions::add_to(CLI::App& command) {
  const CLI::Range count(1, 1 << 26);
  command.add_option("scene", scene, "Scene file (TOML), or a bare mesh: .obj, .ply, .stl, each also .gz")
      ->required();
  command.add_option("--spp", spp, "Camera rays a pixel; powers of two are best for sobol")
      ->check(count)
      ->envname("NOOK_SPP");
  command.add_option("--directions", directions, "Occlusion rays per camera ray")
      ->check(count)
      ->envname("NOOK_DIRECTIONS");
  command.add_option("--sampling", sampling, "cosine, hemisphere, sphere; for RO also lobe, mixture")
      ->envname("NOOK_SAMPLING");
  command.add_option("--sampler", sampler, "independent, stratified, halton, sobol, zorder")
      ->envname("NOOK_SAMPLER");
  command.add_option("--max-distance", max_distance, "auto, none or a distance in world units")
      ->envname("NOOK_MAX_DISTANCE");
  command.add_option("--exponent", exponent, "RO: Phong exponent, 0 to 1e7")
      ->check(CLI::Range(0.0, 1e7))
      ->envname("NOOK_EXPONENT");
  command.add_option("--method", method, "SSAO: point, gtao, march")->envname("NOOK_METHOD");
  command.add_option("--quality", quality, "SSAO: draft, real-time, accurate")->envname("NOOK_QUALITY");
  command.add_option("--radius", radius, "SSAO: world units, or auto: half the bounding radius")
      ->envname("NOOK_RADIUS");
  command.add_option("--seed", seed, "Seed of all random numbers")->envname("NOOK_SEED");
  command.add_option("--size", size, "Image size, e.g. 800x600")->envname("NOOK_SIZE");
  command.add_option("--crop", crop, "Render pixels x0 <= x < x1, y0 <= y < y1 only: x0,x1,y0,y1")
      ->delimiter(',')
      ->expected(4)
      ->envname("NOOK_CROP");
}

void check_samples(const Scene& scene, std::uint64_t spp) {
  const std::uint64_t samples = spp * scene.directions;
  if (samples > most_samples_per_pixel)
    throw Error(ExitCode::scene,
                fmt::format("{}: {} camera rays x {} directions are {} samples a pixel, at most {}",
                            scene.file.string(), spp, scene.directions, samples, most_samples_per_pixel));
}

Scene SceneOptions::load() const {
  if (is_unread_mesh(scene)) refuse_format(scene);
  Scene loaded = is_mesh(scene) ? scene_of_mesh(scene) : load_scene(scene);
  if (exponent && std::isnan(*exponent))
    throw Error(ExitCode::usage, "--exponent: 'nan' is not a number from 0 to 1e7");
  if (spp) loaded.spp = *spp;
  if (directions) loaded.directions = *directions;
  if (seed) loaded.seed = *seed;
  if (sampler) loaded.sampler = chosen<Sampler>("--sampler", *sampler, sampler_names);
  for (Effect& effect : loaded.effects) {
    if (sampling) effect.sampling = chosen<Sampling>("--sampling", *sampling, sampling_names);
    if (exponent) {
      effect.exponent = *exponent;
      effect.exponent_of_material = false;
    }
    if (method) effect.ssao.method = chosen<SsaoSettings::Method>("--method", *method, ssao_method_names);
    if (quality)
      effect.ssao.quality = chosen<SsaoSettings::Quality>("--quality", *quality, ssao_quality_names);
    if (radius) {
      const auto limit = parse_distance_limit(*radius);
      if (!limit || limit->kind == DistanceLimit::Kind::none)
        throw Error(ExitCode::usage,
                    fmt::format("--radius: '{}' is not auto or a distance of at least 0", *radius));
      effect.ssao.radius = limit->kind == DistanceLimit::Kind::value ? limit->value : 0;
    }
    if (max_distance) {
      const auto limit = parse_distance_limit(*max_distance);
      if (!limit)
        throw Error(
            ExitCode::usage,
            fmt::format("--max-distance: '{}' is not auto, none or a distance of at least 0", *max_distance));
      effect.max_distance = *limit;
    }
    if (effect.kind != EffectKind::ro &&
        (effect.sampling == Sampling::lobe || effect.sampling == Sampling::mixture))
      throw Error(ExitCode::usage, fmt::format("--sampling: {} needs an RO scene", name_of(effect.sampling)));
  }
  if (size) std::tie(loaded.width, loaded.height) = parse_size(*size);
  if (!crop.empty()) loaded.crop = PixelRect{crop[0], crop[2], crop[1], crop[3]};
  validate(loaded);
  check_samples(loaded, loaded.spp);
  return loaded;
}

void SceneOptions::check_applicable(const Scene& loaded) const {
  const auto any = [&](auto kind) {
    return std::any_of(loaded.effects.begin(), loaded.effects.end(),
                       [&](const Effect& e) { return kind(e.kind); });
  };
  const bool sampled = any(is_traced);
  const bool reflected = any([](EffectKind kind) { return kind == EffectKind::ro; });
  const bool screen_space = any([](EffectKind kind) { return kind == EffectKind::ssao; });
  const struct {
    const char *flag, *variable;
    bool given, applies;
    const char* what;
  } flags[] = {
      {"--spp", "NOOK_SPP", spp.has_value(), sampled, "an effect with samples"},
      {"--directions", "NOOK_DIRECTIONS", directions.has_value(), sampled, "an effect with samples"},
      {"--sampling", "NOOK_SAMPLING", sampling.has_value(), sampled, "an effect with samples"},
      {"--sampler", "NOOK_SAMPLER", sampler.has_value(), sampled, "an effect with samples"},
      {"--max-distance", "NOOK_MAX_DISTANCE", max_distance.has_value(), sampled, "an effect with samples"},
      {"--exponent", "NOOK_EXPONENT", exponent.has_value(), reflected, "an effect of type ro"},
      {"--method", "NOOK_METHOD", method.has_value(), screen_space, "an effect of type ssao"},
      {"--quality", "NOOK_QUALITY", quality.has_value(), screen_space, "an effect of type ssao"},
      {"--radius", "NOOK_RADIUS", radius.has_value(), screen_space, "an effect of type ssao"}};
  // A variable may be meant for all scenes of a folder; a flag is meant for this one.
  for (const auto& flag : flags)
    if (flag.given && !flag.applies && !std::getenv(flag.variable))
      throw Error(ExitCode::usage, fmt::format("{}: {} has no {}", flag.flag, loaded.file.string(),
                                               std::string_view(flag.what).substr(3)));
}

void keep_inputs(const Scene& scene, const std::filesystem::path& output) {
  const auto refuse = [&](const std::filesystem::path& input) {
    std::error_code code;
    if (std::filesystem::equivalent(input, output, code))
      throw Error(ExitCode::output,
                  fmt::format("{}: is the scene's own file, it would be overwritten", output.string()));
  };
  refuse(scene.file);
  refuse(scene.mesh_file);
  for (const Instance& instance : scene.instances) refuse(instance.mesh_file);
}

void DeviceOptions::add_to(CLI::App& command) {
  command
      .add_option("--device", selector, "cpu, gpu, PLATFORM:DEVICE, or a part of a name (see nook devices)")
      ->envname("NOOK_DEVICE");
  command.add_option("--threads", threads, "Threads to use, of a CPU device and of nook itself; 0: all")
      ->envname("NOOK_THREADS");
}

void DeviceOptions::prepare() const {
  limit_threads(threads);
  limit_exr_threads(threads);
  limit_own_threads(threads);
  give_pocl_its_own_folder();
}

Device DeviceOptions::open() const {
  prepare();
  return Device(select_device(selector));
}

std::string to_toml(const Scene& s) {
  auto point = [](const vec3& p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); };
  std::string input = s.instances.empty() ? fmt::format("objfile = \"{}\"\n", s.mesh_file.string()) : "";
  if (s.cutouts) input += "cutouts = true\n";
  if (s.instancing != Instancing::automatic)
    input += fmt::format("instancing = \"{}\"\n", name_of(s.instancing));
  std::string out = input.empty() ? "" : "[input]\n" + input + '\n';
  for (const Instance& i : s.instances)
    out += fmt::format("[[instance]]\nobjfile = \"{}\"\ntranslate = {}\nrotate = {}\nscale = {}\n\n",
                       i.mesh_file.string(), point(i.translate), point(i.rotate), point(i.scale));
  const auto or_auto = [](const std::optional<float>& value) {
    return value ? fmt::format("{}", *value) : "\"auto\"";
  };
  if (s.ground)
    out += fmt::format("[ground]\nheight = {}\nreach = {}\n\n", or_auto(s.ground->height),
                       or_auto(s.ground->reach));
  if (!s.automatic_camera)
    out += fmt::format("[camera]\neye = {}\nat = {}\nup = {}\nfov = {}\n\n", point(s.camera.eye),
                       point(s.camera.at), point(s.camera.up), s.camera.fov);
  out += fmt::format("[film]\nwidth = {}\nheight = {}\n", s.width, s.height);
  if (s.crop)
    out += fmt::format("crop = [{}, {}, {}, {}]  # x0, x1, y0, y1\n", s.crop->x0, s.crop->x1, s.crop->y0,
                       s.crop->y1);
  const bool single = s.effects.size() == 1 && s.effects.front().name.empty();
  out += fmt::format("\n[renderer]\nrealtime = {}\n", s.realtime);
  if (single) out += effect_toml(s.effects.front());
  if (std::any_of(s.effects.begin(), s.effects.end(),
                  [](const Effect& e) { return e.kind != EffectKind::ssao; }))
    out += stop_toml(s) + fmt::format("directions = {}\nsampler = \"{}\"\nseed = {}\n", s.directions,
                                      name_of(s.sampler), s.seed);
  if (s.denoise) out += "denoise = true\n";
  if (s.compat_tinyrender) out += "compat = \"tinyrender\"\n";
  if (single) return out;
  for (const Effect& effect : s.effects) {
    out += "\n[[effect]]\n";
    if (!effect.name.empty()) out += fmt::format("name = \"{}\"\n", effect.name);
    out += effect_toml(effect);
  }
  return out;
}

std::string scene_hash(const Scene& scene) {
  Scene unnamed = scene;
  unnamed.mesh_file.clear();
  unnamed.denoise = false;  // after the samples, which are the same
  unnamed.stop = {};
  for (Instance& instance : unnamed.instances) instance.mesh_file.clear();
  const std::string text = to_toml(unnamed);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace nook
