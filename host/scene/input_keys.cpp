#include "scene/scene_keys.hpp"

namespace nook {
namespace {

using Form = Domain::Form;

constexpr std::string_view auto_word[] = {"auto"}, ground_words[] = {"auto", "none"};
constexpr std::string_view ground_axes[] = {"auto", "x", "y", "z", "-x", "-y", "-z"};

// A number that is unset, which the word "auto" says.
template <class Owner, auto... Path>
constexpr Field<Owner> or_auto() {
  return {[](const Owner& owner) {
            const auto& value = member<Path...>(owner);
            return value ? packed(*value) : KeyValue("auto");
          },
          field<Owner, Path...>().set};
}

constexpr Field<Ground> height{[](const Ground& ground) {
                                 return ground.none ? KeyValue("none")
                                                    : or_auto<Ground, &Ground::height>().get(ground);
                               },
                               [](Ground& ground, const KeyValue& value) {
                                 unpack(value, ground.height);
                                 ground.none = value == KeyValue("none");
                               }};
constexpr Field<Ground> ground_up{or_auto<Ground, &Ground::up>().get,
                                  [](Ground& ground, const KeyValue& value) {
                                    ground.up = value_of<Axis>(axis_names, std::get<std::string>(value));
                                  }};

template <auto First>
constexpr Field<Instance> file() {
  return {[](const Instance& i) { return KeyValue((i.*First).string()); },
          [](Instance& i, const KeyValue& value) { i.*First = std::get<std::string>(value); }};
}

// With several meshes, [[instance]] has them.
constexpr Field<Scene> meshes{
    [](const Scene& s) { return s.instances.empty() ? KeyValue(s.mesh_file.string()) : KeyValue(); },
    [](Scene& s, const KeyValue& value) {
      if (const auto* list = std::get_if<std::vector<std::string>>(&value))
        for (const std::string& name : *list) s.instances.push_back({name, dvec3(0), vec3(0), vec3(1)});
      else
        s.mesh_file = std::get<std::string>(value);
    }};

const Key<Scene> of_input[] = {
    {{.name = "objfile",
      .domain = {.form = Form::files, .noun = "the name of a mesh, or a list of names"},
      .help = "mesh, or a list of meshes +, relative to the scene's folder: Wavefront OBJ, PLY + or STL +, "
              "each also compressed (`.gz` +), by the ending of its name; see [mesh files](#mesh-files)",
      .default_says = "required without [[instance]]",
      .of_nook = false,
      .of_samples = false},
     meshes},
    {{.name = "cutouts",
      .domain = yes_or_no,
      .help = "true: materials' opacity maps (`map_d`, PNG) cut holes; see [effects](effects.md#cut-outs)"},
     field<Scene, &Scene::cutouts>()},
    {{.name = "instancing",
      .domain = choice<instancing_names>(),
      .help =
          "`tree`: each mesh is kept once, with a tree over its places; `copies`: an instance is a copy with "
          "triangles of its own; the same picture. `auto` chooses, and `nook plan` says why; see "
          "[effects](effects.md#several-meshes-instances-a-ground)"},
     field<Scene, &Scene::instancing>()},
};

const Key<Instance> of_instance[] = {
    {{.name = "objfile",
      .domain = {.form = Form::text, .noun = "the name of a mesh"},
      .help = "mesh, relative to the scene's folder",
      .default_says = "required",
      .of_samples = false},
     file<&Instance::mesh_file>()},
    {{.name = "translate", .domain = {.form = Form::point, .unit = "world units"}, .help = "added last"},
     field<Instance, &Instance::translate>()},
    {{.name = "rotate",
      .domain = {.form = Form::point, .unit = "degrees"},
      .help = "about x, then y, then z"},
     field<Instance, &Instance::rotate>()},
    {{.name = "scale",
      .domain = {.form = Form::scale},
      .help = "of all axes, or of each. A negative one mirrors, and the winding turns with it"},
     field<Instance, &Instance::scale>()},
};

const Key<Ground> of_ground[] = {
    {{.name = "height",
      .domain = {.lo = -1e30, .hi = 1e30, .unit = "world units", .words = ground_words},
      .help = "along the ground's `up`; `\"auto\"`: the lowest point of the mesh; `\"none\"`: there is no "
              "ground",
      .flag = "--ground"},
     height},
    {{.name = "reach",
      .domain = {.lo = 1e-30, .hi = 1e30, .noun = "a distance", .unit = "world units", .words = auto_word},
      .help = "from the mesh's center to each side; `\"auto\"`: 20 bounding radii, or (framed) beyond the "
              "picture"},
     or_auto<Ground, &Ground::reach>()},
    {{.name = "up",
      .domain = {.form = Form::choice, .words = ground_axes},
      .help = "the axis that it is across, and faces; `\"auto\"`: y, or (framed) the one nearest to the "
              "camera's `up`"},
     ground_up},
};

}  // namespace

std::span<const Key<Scene>> input_keys() {
  return of_input;
}
std::span<const Key<Instance>> instance_keys() {
  return of_instance;
}
std::span<const Key<Ground>> ground_keys() {
  return of_ground;
}

}  // namespace nook
