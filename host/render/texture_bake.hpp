#pragma once

#include <string>
#include <vector>

#include "points/texture_points.hpp"
#include "render/scene_renderer.hpp"

namespace nook {

/// What is asked of a texture.
struct TextureRequest {
  int size = 1024;                ///< texels on a side, 1 to 16384
  int dilation = 8;               ///< rings of texels around what is covered, 0 to 1024
  std::vector<std::string> aovs;  ///< "normal", "position", "variance", "samples"
};

/// Before anything is loaded. Throws Error(usage) for channels that textures lack, Error(scene) for want of
/// memory, in the words of flags.
void check_texture(const TextureRequest& request, const Scene& scene);

/// The texels of a mesh to bake at. What a user should know of them is told to `observer`. Throws
/// Error(scene) that names the scene's mesh.
TexturePoints texels_of(const SceneRenderer& renderer, const TextureRequest& request, RunObserver& observer);

/// The plan's effects at them, of a scene_to_bake(): the channels of a picture, and A, which is 1 on covered
/// texels and 0 elsewhere. Throws as bake_at().
Image bake_texture(SceneRenderer& renderer, const TexturePoints& texels, const TextureRequest& request,
                   RunObserver* observer = nullptr);

}  // namespace nook
