#include "workspace.hpp"

#include <algorithm>
#include <utility>

#include "jobs.hpp"
#include "mesh/load_mesh.hpp"
#include "plan/scene_ground.hpp"
#include "plan/scene_mesh.hpp"
#include "scene/scene_toml.hpp"
#include "scene/scene_writer.hpp"
#include "scene/settings.hpp"

namespace nook::python {
namespace {

constexpr std::size_t most_ready = 8;

Scene scene_of_file(const std::filesystem::path& file) {
  if (is_unread_mesh(file)) refuse_format(file);
  return is_mesh(file) ? scene_of_mesh(file) : load_scene(file);
}

bool covers(const MeshAttributes& has, const MeshAttributes& needs) {
  return has.normals >= needs.normals && has.uvs >= needs.uvs && has.materials >= needs.materials &&
         has.groups >= needs.groups && has.exponents >= needs.exponents;
}

MeshAttributes both(const MeshAttributes& a, const MeshAttributes& b) {
  return {a.normals || b.normals, a.uvs || b.uvs, a.materials || b.materials, a.groups || b.groups,
          a.exponents || b.exponents};
}

Device open(const std::string& selector) {
  return Device(select_device(selector));
}

}  // namespace

Workspace::Workspace(const std::filesystem::path& file, const std::string& settings, std::string device)
    : device_(std::move(device)), of_file_(true), scene_(scene_of_file(file)) {
  apply_settings(settings, true, scene_);
  validate(scene_);
  check_samples(scene_, scene_.spp);
  make_plan(scene_, load(scene_, needed_attributes(scene_), false).get());
}

Workspace::Workspace(TriangleMesh mesh, const std::string& settings, std::string device)
    : device_(std::move(device)), of_file_(false), scene_(scene_of_mesh("mesh")) {
  apply_settings(settings, true, scene_);
  validate(scene_);
  check_samples(scene_, scene_.spp);
  if (scene_.ground) add_ground(scene_, mesh);
  make_plan(scene_, mesh);
  bases_.push_back({{.normals = true, .uvs = true, .materials = true, .groups = true, .exponents = true},
                    std::move(mesh),
                    nullptr});
}

Scene Workspace::with(const std::string& settings) const {
  Scene scene = scene_;
  apply_settings(settings, false, scene);
  validate(scene);
  check_samples(scene, scene.spp);
  return scene;
}

Workspace::Base& Workspace::load(const Scene& scene, const MeshAttributes& attributes, bool copies) {
  TriangleMesh mesh = load_scene_mesh(scene, attributes, copies ? Instancing::copies : scene.instancing);
  if (bases_.empty()) warnings_ = mesh.report.warnings;
  bases_.push_back({attributes, std::move(mesh), nullptr});
  return bases_.back();
}

Workspace::Base& Workspace::base(const Scene& scene, const Use& use) {
  const bool copies =
      use.copies || std::any_of(scene.effects.begin(), scene.effects.end(),
                                [](const Effect& e) { return e.kind == EffectKind::ssao || e.only_self; });
  for (Base& each : bases_)
    if (covers(each.attributes, use.attributes) && !(copies && !each.get().instances.empty())) return each;
  return load(scene, both(use.attributes, bases_.front().attributes), copies);
}

SceneRenderer& Workspace::renderer(const Scene& scene, const Use& use) {
  check_fork();
  Base& of = base(scene, use);
  std::string key = to_toml(scene) + (use.surface ? "# surface" : use.shift_points ? "" : "# as they are");
  if (!use.point_set.empty())
    key.append(reinterpret_cast<const char*>(use.point_set.data()), use.point_set.size() * sizeof(vec2));
  const auto found = std::find_if(ready_.begin(), ready_.end(),
                                  [&](const Ready& ready) { return ready.base == &of && ready.key == key; });
  if (found != ready_.end()) {
    ready_.splice(ready_.begin(), ready_, found);
    return ready_.front().renderer;
  }
  if (!of.renderer) {
    use_device();
    SceneRendererOptions options;
    options.mesh_of_files = of_file_;
    of.renderer = std::make_unique<SceneRenderer>(
        scene_, std::move(of.mesh), [device = device_] { return open(device); }, std::move(options));
  }
  ready_.push_front({&of, key, SceneRenderer(*of.renderer, scene, use.surface)});
  if (ready_.size() > most_ready) ready_.pop_back();
  SceneRenderer& made = ready_.front().renderer;
  if (!use.point_set.empty()) {
    Plan plan = made.plan();
    plan.point_set = use.point_set;
    plan.shift_points = use.shift_points;
    made.set_plan(std::move(plan));
  }
  return made;
}

std::vector<std::string> Workspace::take_warnings() {
  return std::exchange(warnings_, {});
}

}  // namespace nook::python
