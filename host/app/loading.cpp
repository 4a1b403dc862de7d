#include "app/loading.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "render/scene_mesh.hpp"

namespace nook {

TriangleMesh load_and_warn(const Scene& scene, const MeshAttributes& attributes, Instancing instancing) {
  TriangleMesh mesh = load_scene_mesh(scene, attributes, instancing);
  for (const std::string& warning : mesh.report.warnings)
    std::fputs(fmt::format("warning: {}\n", warning).c_str(), stderr);
  return mesh;
}

}  // namespace nook
