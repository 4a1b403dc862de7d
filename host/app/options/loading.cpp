#include "app/options/loading.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "plan/scene_mesh.hpp"

namespace nook {

void warn_of(const TriangleMesh& mesh) {
  for (const std::string& warning : mesh.report.warnings)
    std::fputs(fmt::format("warning: {}\n", warning).c_str(), stderr);
}

TriangleMesh load_and_warn(const Scene& scene, const MeshAttributes& attributes, Instancing instancing) {
  TriangleMesh mesh = load_scene_mesh(scene, attributes, instancing);
  warn_of(mesh);
  return mesh;
}

}  // namespace nook
