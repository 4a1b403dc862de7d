#pragma once

#include <string>

#include "estimates.hpp"
#include "render/bake.hpp"
#include "render/texture_bake.hpp"

namespace nook::python {

/// What was baked onto a mesh, and the mesh: its positions and triangles, as the scene has them.
struct Bake {
  TriangleMesh mesh;
  MeshBake baked;
  std::vector<Layer> layers;
  bool corners = false;  ///< a value for each corner of the triangles, and not for each position
};

/// As `nook bake --to vertices` and `--to corners` make it, to the same bits. Throws Error.
Bake bake(Workspace& workspace, bool corners, const std::string& settings, RunObserver& observer);

/// As `nook bake --to texture` makes it, to the same bits. Throws Error.
Picture bake(Workspace& workspace, const TextureRequest& request, const std::string& settings,
             RunObserver& observer);

/// A PLY file. Throws Error(output).
void write(const Bake& bake, const std::filesystem::path& file);

}  // namespace nook::python
