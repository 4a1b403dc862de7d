#include "plan/scene_mesh.hpp"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "mesh/instance.hpp"
#include "mesh/load_mesh.hpp"
#include "mesh/opacity_maps.hpp"
#include "plan/scene_ground.hpp"

namespace nook {
namespace {

// p -> translate + Rz Ry Rx scale p.
glm::dmat4 matrix_of(const Instance& instance) {
  glm::dmat4 m = glm::translate(glm::dmat4(1), instance.translate);
  for (int axis = 2; axis >= 0; --axis) {
    dvec3 about(0);
    about[axis] = 1;
    if (instance.rotate[axis] != 0) m = glm::rotate(m, glm::radians(double(instance.rotate[axis])), about);
  }
  return glm::scale(m, dvec3(instance.scale));
}

// The scene's mesh files, each read once, and how often each is placed, by its name.
struct Files {
  std::map<std::filesystem::path, TriangleMesh> meshes;
  InstanceCounts counts;
  std::vector<std::string> warnings;  // the files'
};

Files load_files(const Scene& scene, const MeshAttributes& attributes) {
  Files files;
  for (const Instance& instance : scene.instances) {
    const auto [place, fresh] = files.meshes.try_emplace(instance.mesh_file);
    if (fresh) {
      place->second = load_mesh(instance.mesh_file, attributes);
      for (std::string& warning : place->second.report.warnings) files.warnings.push_back(std::move(warning));
    }
    const std::uint64_t triangles = place->second.triangles.size();
    files.counts.stored += fresh ? triangles : 0;
    files.counts.placed += triangles;
  }
  return files;
}

glm::dmat4 to_file(const Frame& frame) {
  return glm::scale(glm::translate(glm::dmat4(1), frame.center), dvec3(frame.to_file(1)));
}

glm::dmat4 from_file(const Frame& frame) {
  return glm::translate(glm::scale(glm::dmat4(1), dvec3(frame.from_file(1))), -frame.center);
}

// Of all instances.
Frame frame_of(const Scene& scene, const Files& files) {
  dvec3 lo(HUGE_VAL), hi(-HUGE_VAL);
  for (const Instance& instance : scene.instances) {
    const TriangleMesh& mesh = files.meshes.at(instance.mesh_file);
    const glm::dmat4 transform = matrix_of(instance);
    for (int corner = 0; corner < 8; ++corner) {
      const Bounds3& b = mesh.bounds;
      const dvec3 p(corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y, corner & 4 ? b.hi.z : b.lo.z);
      const dvec3 placed(transform * glm::dvec4(mesh.frame.to_file(p), 1));
      lo = glm::min(lo, placed);
      hi = glm::max(hi, placed);
    }
  }
  if (!finite(vec3(lo)) || !finite(vec3(hi)))
    throw Error(ErrorKind::scene, Place{scene.file.string()},
                "an instance's vertices are beyond the range of floats");
  return frame_for(lo, hi);
}

// From the mesh's coordinates in memory to the whole's.
glm::dmat4 matrix_between(const Frame& whole, const Instance& instance, const Frame& mesh) {
  const glm::dmat4 in_files = matrix_of(instance);
  return whole == Frame() && mesh == Frame() ? in_files : from_file(whole) * in_files * to_file(mesh);
}

// The instances as copies, or each file once (and once more if some of its instances mirror it) with its
// places.
TriangleMesh place_files(const Scene& scene, Files files, bool as_trees) {
  TriangleMesh whole;
  whole.frame = frame_of(scene, files);
  std::map<std::pair<std::filesystem::path, bool>, std::uint32_t> parts;
  for (const Instance& instance : scene.instances) {
    const TriangleMesh& mesh = files.meshes.at(instance.mesh_file);
    const glm::dmat4 transform = matrix_between(whole.frame, instance, mesh.frame);
    try {
      if (!as_trees) {
        append_instance(whole, mesh, transform);
        continue;
      }
      const auto [part, fresh] = parts.try_emplace({instance.mesh_file, mirrors(transform)});
      if (fresh) part->second = append_model(whole, mesh, mirrors(transform));
      place_model(whole, part->second, transform);
    } catch (const Error& e) {
      throw Error(e.kind(), Place{scene.file.string()}, e.what());
    }
  }
  return whole;
}

}  // namespace

std::string reason_for_copies(const Scene& scene, Instancing instancing, const InstanceCounts& counts) {
  if (instancing == Instancing::copies) return "the scene asks for them (instancing)";
  for (const Effect& effect : scene.effects) {
    if (effect.kind == EffectKind::ssao) return "SSAO draws triangles";
    if (effect.only_self) return "occluders = \"self\" has a tree for each group";
  }
  if (instancing == Instancing::tree) return "";
  if (counts.placed < fewest_triangles_for_trees)
    return fmt::format("they have {} triangles, fewer than {}", counts.placed, fewest_triangles_for_trees);
  if (counts.placed < 2 * counts.stored) return "most meshes are placed once";
  return "";
}

TriangleMesh load_scene_mesh(const Scene& scene, const MeshAttributes& attributes, Instancing instancing) {
  TriangleMesh whole;
  if (scene.instances.empty()) {
    whole = load_mesh(scene.mesh_file, attributes);
  } else {
    Files files = load_files(scene, attributes);
    const std::string why_copies = reason_for_copies(scene, instancing, files.counts);
    if (instancing == Instancing::tree && !why_copies.empty())
      throw Error(ErrorKind::scene, Place{scene.file.string()},
                  fmt::format("instancing = \"tree\": {}", why_copies));
    std::vector<std::string> warnings = std::move(files.warnings);
    whole = place_files(scene, std::move(files), why_copies.empty());
    whole.report.warnings = std::move(warnings);
    whole.why_copies = why_copies;
  }
  if (scene.ground) add_ground(scene, whole);
  if (scene.cutouts && attributes.materials) load_opacity_maps(whole);
  return whole;
}

}  // namespace nook
