#include "scene/input_toml.hpp"

#include <cmath>

namespace nook {
namespace {

std::vector<std::filesystem::path> read_files(TomlTable& input, const std::filesystem::path& folder) {
  const toml::node* node = input.find("objfile");
  if (!node) input.missing("objfile");
  const toml::array* list = node->as_array();
  if (!list) {
    const std::string name = input.text("objfile", "");
    if (name.empty()) input.wrong(*node, "objfile", "the name of a mesh");
    return {folder / name};
  }
  std::vector<std::filesystem::path> files;
  for (const toml::node& element : *list) {
    if (!element.is_string() || (*element.as_string())->empty())
      input.wrong(element, "objfile", "a string, or a list of strings");
    files.push_back(folder / **element.as_string());
  }
  if (files.empty()) input.wrong(*node, "objfile", "a string, or a list of strings");
  return files;
}

Instance read_instance(TomlTable& table, const std::filesystem::path& folder) {
  Instance instance;
  if (!table.has("objfile")) table.missing("objfile");
  instance.mesh_file = folder / table.text("objfile", "");
  instance.translate = table.point("translate", instance.translate);
  instance.rotate = table.point("rotate", instance.rotate);
  const toml::node* scale = table.find("scale");
  if (scale && scale->is_number())
    instance.scale = vec3(float(table.number("scale", 1, -1e30, 1e30, "a number other than 0, or three")));
  else
    instance.scale = table.point("scale", instance.scale);
  if (scale && !(instance.scale.x != 0 && instance.scale.y != 0 && instance.scale.z != 0))
    table.wrong(*scale, "scale", "a number other than 0, or three");
  table.finish();
  return instance;
}

// A number, or "auto".
std::optional<float> number_or_auto(TomlTable& table, const char* key, double lo, const char* what) {
  const toml::node* node = table.find(key);
  if (!node || (node->is_string() && node->value_or("") == std::string("auto"))) return std::nullopt;
  return float(table.number(key, 0, lo, 1e30, what));
}

}  // namespace

void read_input(TomlTable& input, TomlTable& ground, const toml::node* instances, Scene& scene) {
  const std::filesystem::path folder = scene.file.parent_path();
  const toml::array* list = instances ? instances->as_array() : nullptr;
  if (instances && (!list || list->empty() || !list->is_homogeneous<toml::table>()))
    fail_at(input.file(), instances->source(), "instances are tables: [[instance]]");
  if (!list || input.has("objfile")) {
    const std::vector<std::filesystem::path> files = read_files(input, folder);
    scene.mesh_file = files.front();
    if (list || files.size() > 1)
      for (const std::filesystem::path& file : files)
        scene.instances.push_back({file, vec3(0), vec3(0), vec3(1)});
  }
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    TomlTable table(input.file(), "[[instance]]", list->get(i)->as_table());
    scene.instances.push_back(read_instance(table, folder));
  }
  if (!scene.instances.empty()) scene.mesh_file = scene.instances.front().mesh_file;
  scene.cutouts = input.boolean("cutouts", false);
  scene.instancing = input.choice<Instancing>("instancing", Instancing::automatic, instancing_names);
  if (scene.instances.empty() && scene.instancing != Instancing::automatic)
    fail_at(input.file(), input.find("instancing")->source(),
            "instancing needs [[instance]] or a list of meshes");
  if (!ground) return;
  scene.ground.emplace();
  scene.ground->height = number_or_auto(ground, "height", -1e30, "a number, or \"auto\"");
  scene.ground->reach = number_or_auto(ground, "reach", 1e-30, "a distance above 0, or \"auto\"");
}

}  // namespace nook
