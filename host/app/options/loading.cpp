#include "app/options/loading.hpp"

#include "base/to_stderr.hpp"
#include "plan/proportions.hpp"
#include "plan/scene_mesh.hpp"

namespace nook {

void warn_of(const Scene& scene, const TriangleMesh& mesh, Viewer viewer) {
  for (const std::string& warning : mesh.report.warnings) to_stderr("warning: {}\n", warning);
  const std::string proportions = proportions_warning(scene, mesh, viewer == Viewer::camera);
  if (!proportions.empty()) to_stderr("warning: {}\n", proportions);
}

TriangleMesh load_and_warn(const Scene& scene, const MeshAttributes& attributes, Instancing instancing) {
  TriangleMesh mesh = load_scene_mesh(scene, attributes, instancing);
  warn_of(scene, mesh, Viewer::camera);
  return mesh;
}

}  // namespace nook
