#include "render/scene_mesh.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "base/error.hpp"
#include "mesh/instance.hpp"
#include "mesh/ply.hpp"
#include "render/cut_outs.hpp"

namespace nook {
namespace {

// p -> translate + Rz Ry Rx scale p.
glm::dmat4 matrix_of(const Instance& instance) {
  glm::dmat4 m = glm::translate(glm::dmat4(1), dvec3(instance.translate));
  for (int axis = 2; axis >= 0; --axis) {
    dvec3 about(0);
    about[axis] = 1;
    if (instance.rotate[axis] != 0) m = glm::rotate(m, glm::radians(double(instance.rotate[axis])), about);
  }
  return glm::scale(m, dvec3(instance.scale));
}

}  // namespace

TriangleMesh load_scene_mesh(const Scene& scene, const MeshAttributes& attributes) {
  TriangleMesh whole;
  if (scene.instances.empty()) {
    whole = load_mesh(scene.mesh_file, attributes);
  } else {
    std::map<std::filesystem::path, TriangleMesh> files;
    for (const Instance& instance : scene.instances) {
      const auto [place, fresh] = files.try_emplace(instance.mesh_file);
      if (fresh) place->second = load_mesh(instance.mesh_file, attributes);
      try {
        append_instance(whole, place->second, matrix_of(instance));
      } catch (const Error& e) {
        throw Error(e.code(), scene.file.string() + ": " + e.what());
      }
    }
  }
  if (scene.ground) {
    const float height = scene.ground->height.value_or(whole.bounds.lo.y);
    append_ground(whole, height, scene.ground->reach.value_or(20 * whole.bounds.bounding_radius()));
  }
  if (scene.cutouts && attributes.materials) load_opacity_maps(whole);
  return whole;
}

}  // namespace nook
