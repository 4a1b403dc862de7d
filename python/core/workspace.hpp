#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "render/scene_renderer.hpp"
#include "scene/scene.hpp"

namespace nook::python {

/// A scene with its mesh, and what was made ready for the estimates and pictures asked of it: the next call
/// with the same settings starts at once. The mesh is there from the start, OpenCL from the first call on.
/// Whoever uses it holds its mutex.
class Workspace {
 public:
  /// settings: see apply_settings(). device: as select_device() has it. Throws Error.
  Workspace(const std::filesystem::path& file, const std::string& settings, std::string device);
  Workspace(TriangleMesh mesh, const std::string& settings, std::string device);

  std::mutex mutex;

  const Scene& scene() const { return scene_; }
  /// The scene with settings of one call. Throws Error(usage).
  Scene with(const std::string& settings) const;

  /// What a renderer is for.
  struct Use {
    MeshAttributes attributes;         ///< that it reads
    bool surface = false;              ///< SceneRendererOptions::surface
    bool copies = false;               ///< triangles themselves are read: instances are copies
    std::vector<vec2> point_set = {};  ///< Plan::point_set
    bool shift_points = true;          ///< Plan::shift_points
  };
  /// Of `scene`, which is this one with other settings; valid until the next call. Throws Error.
  SceneRenderer& renderer(const Scene& scene, const Use& use);

  /// The scene's mesh with at least these attributes, its instances as the scene has them; likewise.
  const TriangleMesh& mesh(const MeshAttributes& attributes) { return base(scene_, {attributes}).get(); }

  /// What readers warned of since the last call, a line each.
  std::vector<std::string> take_warnings();

 private:
  // A mesh, and on it the renderer whose device and trees others share.
  struct Base {
    MeshAttributes attributes;
    TriangleMesh mesh;  // until there is a renderer
    std::unique_ptr<SceneRenderer> renderer;
    const TriangleMesh& get() const { return renderer ? renderer->mesh() : mesh; }
  };
  struct Ready {
    const Base* base;
    std::string key;
    SceneRenderer renderer;
  };
  Base& base(const Scene& scene, const Use& use);
  Base& load(const Scene& scene, const MeshAttributes& attributes, bool copies);

  std::string device_;
  bool of_file_;
  Scene scene_;
  std::list<Base> bases_;
  std::list<Ready> ready_;  // the last used first
  std::vector<std::string> warnings_;
};

}  // namespace nook::python
