#include "scene/input_toml.hpp"

#include "scene/scene_keys.hpp"

namespace nook {
namespace {

Instance read_instance(TomlTable& table, const std::filesystem::path& folder) {
  Instance instance;
  if (!table.has("objfile")) table.missing("objfile");
  read_keys(table, instance_keys(), instance);
  instance.mesh_file = folder / instance.mesh_file;
  table.finish();
  return instance;
}

}  // namespace

void read_input(TomlTable& input, TomlTable& ground, const toml::node* instances, Scene& scene) {
  const std::filesystem::path folder = scene.file.parent_path();
  const toml::array* list = instances ? instances->as_array() : nullptr;
  if (instances && (!list || list->empty() || !list->is_homogeneous<toml::table>()))
    fail_at(input.file(), instances->source(), "instances are tables: [[instance]]");
  if (!list && !input.has("objfile")) input.missing("objfile");
  read_keys(input, input_keys(), scene);
  scene.mesh_file = folder / scene.mesh_file;
  for (Instance& instance : scene.instances) instance.mesh_file = folder / instance.mesh_file;
  // A list of one is that mesh; beside [[instance]], one mesh is an instance too.
  if (scene.instances.size() == 1 && !list) {
    scene.mesh_file = scene.instances.front().mesh_file;
    scene.instances.clear();
  } else if (list && scene.instances.empty() && input.has("objfile")) {
    scene.instances.push_back({scene.mesh_file, dvec3(0), vec3(0), vec3(1)});
  }
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    TomlTable table(input.file(), "[[instance]]", list->get(i)->as_table());
    scene.instances.push_back(read_instance(table, folder));
  }
  if (!scene.instances.empty()) scene.mesh_file = scene.instances.front().mesh_file;
  if (scene.instances.empty() && scene.instancing != Instancing::automatic)
    fail_at(input.file(), input.find("instancing")->source(),
            "instancing needs [[instance]] or a list of meshes");
  if (!ground) return;
  scene.ground.emplace();
  read_keys(ground, ground_keys(), *scene.ground);
  if (scene.ground->none) scene.ground.reset();
}

}  // namespace nook
