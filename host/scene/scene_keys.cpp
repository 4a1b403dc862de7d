#include "scene/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/effect_keys.hpp"

namespace nook {
namespace {

using Form = Domain::Form;

constexpr std::pair<std::string_view, bool> compat_names[] = {{"none", false}, {"tinyrender", true}};
constexpr double most_samples = 1 << 26;

constexpr Field<Scene> compat{
    [](const Scene& s) { return KeyValue(std::string(name_of<bool>(compat_names, s.compat_tinyrender))); },
    [](Scene& s, const KeyValue& value) {
      s.compat_tinyrender = *value_of<bool>(compat_names, std::get<std::string>(value));
    }};

constexpr std::string_view auto_word[] = {"auto"};
constexpr Field<Scene> directions{
    [](const Scene& s) {
      return s.chooses_directions() ? KeyValue("auto") : KeyValue(std::int64_t(s.directions));
    },
    [](Scene& s, const KeyValue& value) {
      const bool chosen = std::holds_alternative<std::string>(value);
      s.direction_choice = chosen ? Scene::DirectionChoice::automatic : Scene::DirectionChoice::given;
      s.directions = 1;
      if (!chosen) unpack(value, s.directions);
    }};

constexpr auto without_stop = [](const Scene& s) { return !s.stop.any(); };
constexpr auto with_stop = [](const Scene& s) { return s.stop.any(); };
constexpr auto with_error = [](const Scene& s) { return s.stop.error.has_value(); };
constexpr auto own_camera = [](const Scene& s) { return !s.automatic_camera; };
constexpr auto framed = [](const Scene& s) { return s.automatic_camera; };
constexpr std::string_view eye_and_at_follow = "eye and at follow from frame = true, or from view";

// A view is a camera that frames the mesh.
constexpr Field<Scene> view{field<Scene, &Scene::view>().get, [](Scene& s, const KeyValue& value) {
                              unpack(value, s.view);
                              s.automatic_camera = true;
                            }};

const Key<Scene> of_camera[] = {
    {{.name = "frame",
      .domain = yes_or_no,
      .help = "true: the camera frames the mesh, and `eye` and `at` follow; see [framing](#framing)"},
     field<Scene, &Scene::automatic_camera>()},
    {{.name = "view",
      .domain = {.form = Form::view, .words = words_of<view_names>},
      .help = "the side of the mesh that a camera sees which frames it; implies `frame`",
      .flag = "--view",
      .default_says = "`\"three-quarter\"`, which is `\"30,25\"`"},
     view,
     framed},
    {{.name = "margin",
      .domain = {.lo = 0, .hi = 0.45, .noun = "a share"},
      .help = "of a framed picture's width and height: what stays free on each side",
      .flag = "--margin",
      .needs = "margin goes with frame = true, or with view"},
     field<Scene, &Scene::margin>(),
     framed},
    {{.name = "eye",
      .domain = {.form = Form::point, .unit = "world units"},
      .help = "where a right-handed pinhole camera stands",
      .needs = eye_and_at_follow,
      .of_nook = false},
     field<Scene, &Scene::camera, &Camera::eye>(),
     own_camera},
    {{.name = "at",
      .domain = {.form = Form::point, .unit = "world units"},
      .help = "what it looks at",
      .needs = eye_and_at_follow,
      .of_nook = false},
     field<Scene, &Scene::camera, &Camera::at>(),
     own_camera},
    {{.name = "up",
      .domain = {.form = Form::point, .words = words_of<axis_names>},
      .help = "what is up in the picture, or (framed) for the mesh",
      .flag = "--up",
      .of_nook = false},
     field<Scene, &Scene::camera, &Camera::up>()},
    {{.name = "fov",
      .domain = {.lo = 0, .hi = 180, .above = true, .below = true, .noun = "an angle", .unit = "degrees"},
      .help = "vertical field of view",
      .of_nook = false},
     field<Scene, &Scene::camera, &Camera::fov>()},
};

const Key<Scene> of_film[] = {
    {{.name = "width", .domain = integer(1, 65535, "pixels"), .help = "of the picture", .of_nook = false},
     field<Scene, &Scene::width>()},
    {{.name = "height",
      .domain = integer(1, 65535, "pixels"),
      .help = "of the picture; row 0 is the top",
      .of_nook = false},
     field<Scene, &Scene::height>()},
    {{.name = "crop",
      .domain = {.form = Form::crop},
      .help = "pixels x0 <= x < x1, y0 <= y < y1 alone",
      .default_says = "whole"},
     field<Scene, &Scene::crop>()},
    {{.name = "background",
      .domain = {.form = Form::color, .words = words_of<background_names>},
      .help = "of the PNG, where camera rays hit nothing, and of the ground: a color, or alpha. The EXR is "
              "the same",
      .flag = "--background",
      .of_samples = false},
     field<Scene, &Scene::background>()},
};

const Key<Scene> of_renderer[] = {
    {{.name = "realtime",
      .domain = yes_or_no,
      .help = "true: `type` is `ssao`, drawn by OpenGL",
      .of_nook = false},
     field<Scene, &Scene::realtime>()},
    {{.name = "spp",
      .domain = integer(1, most_samples),
      .readers = traced_kinds,
      .help = "camera rays a pixel; powers of two are best for `sobol`",
      .flag = "--spp",
      .needs = "spp and error or time exclude one another; max_spp bounds them",
      .of_nook = false},
     field<Scene, &Scene::spp>(),
     without_stop},
    {{.name = "error",
      .domain = {.lo = 1e-4, .hi = 1, .noun = "a standard error"},
      .readers = traced_kinds,
      .help = "instead of `spp`: render until each pixel has this standard error; see [targets](study.md)",
      .flag = "--error",
      .of_samples = false},
     field<Scene, &Scene::stop, &StopTarget::error>()},
    {{.name = "confidence",
      .domain = {.lo = 0.5, .hi = 0.9999, .noun = ""},
      .readers = traced_kinds,
      .help = "with `error`: of the intervals behind it",
      .flag = "--confidence",
      .needs = "confidence goes with error",
      .of_samples = false},
     field<Scene, &Scene::stop, &StopTarget::confidence>(),
     with_error},
    {{.name = "time",
      .domain = {.lo = 0.05, .hi = 1e7, .noun = "seconds"},
      .readers = traced_kinds,
      .help =
          "instead of `spp`, or beside `error`: from the start of the command; the picture is then written, "
          "as good as it is",
      .flag = "--time",
      .of_samples = false},
     field<Scene, &Scene::stop, &StopTarget::seconds>()},
    {{.name = "min_spp",
      .domain = integer(1, most_samples),
      .readers = traced_kinds,
      .help = "with `error`: camera rays before a pixel may stop",
      .flag = "--min-spp",
      .needs = "min_spp goes with error",
      .of_samples = false},
     field<Scene, &Scene::stop, &StopTarget::min_spp>(),
     with_error},
    {{.name = "max_spp",
      .domain = integer(1, most_samples),
      .readers = traced_kinds,
      .help = "with `error` or `time`: camera rays a pixel at most",
      .flag = "--max-spp",
      .needs = "max_spp goes with error or time",
      .of_samples = false},
     field<Scene, &Scene::stop, &StopTarget::max_spp>(),
     with_stop},
    {{.name = "directions",
      .domain = {.form = Form::integer, .lo = 1, .hi = most_samples, .words = auto_word},
      .readers = traced_kinds,
      .help = "occlusion rays per camera ray; times `spp` (or `max_spp`) at most 2^28; `auto`: a pilot "
              "chooses, see [directions](study.md#directions-a-camera-ray)",
      .flag = "--directions",
      .default_says = "1; `auto` with `error`, if `sampler` is `sobol` or `halton`"},
     directions},
    {{.name = "sampler",
      .domain = choice<sampler_names>(),
      .readers = traced_kinds,
      .help = "the point sequence; see [estimators](estimators.md)",
      .flag = "--sampler"},
     field<Scene, &Scene::sampler>()},
    {{.name = "seed",
      .domain = integer(0, 4294967295.0),
      .readers = traced_kinds,
      .help = "of all random numbers",
      .flag = "--seed"},
     field<Scene, &Scene::seed>()},
    {{.name = "denoise",
      .domain = yes_or_no,
      .readers = traced_kinds,
      .help = "what is traced is filtered: less noise, some bias; see [effects](effects.md#denoising)",
      .flag = "--denoise",
      .of_samples = false},
     field<Scene, &Scene::denoise>()},
    {{.name = "compat",
      .domain = choice<compat_names>(),
      .help = "`tinyrender`: an automatic AO distance is 1.5, as in the course's published images"},
     compat},
};

}  // namespace

std::span<const Key<Scene>> camera_keys() {
  return of_camera;
}
std::span<const Key<Scene>> film_keys() {
  return of_film;
}
std::span<const Key<Scene>> renderer_keys() {
  return of_renderer;
}

const KeyInfo* key_of_flag(std::string_view flag) {
  const KeyInfo* found = nullptr;
  const auto look = [&](const auto& keys) {
    for (const auto& key : keys)
      if (!flag.empty() && key.info.flag == flag) found = &key.info;
  };
  look(camera_keys());
  look(film_keys());
  look(ground_keys());
  look(renderer_keys());
  look(effect_keys());
  return found;
}

bool is_read(const KeyInfo& key, const Scene& scene) {
  return std::any_of(scene.effects.begin(), scene.effects.end(),
                     [&](const Effect& e) { return key.readers.contains(e.kind); });
}

std::string readers_text(const KeyInfo& key) {
  if (key.readers == traced_kinds) return "with samples";
  std::vector<std::string_view> types;
  for (const auto& [name, kind] : effect_names)
    if (key.readers.contains(kind)) types.push_back(name);
  const std::string_view last = types.back();
  types.pop_back();
  return types.empty() ? fmt::format("of type {}", last)
                       : fmt::format("of type {} or {}", fmt::join(types, ", "), last);
}

}  // namespace nook
