#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/picture_run.hpp"
#include "scene/scene.hpp"

namespace nook {

/// What a picture says of how it was made: enough to make it again.
struct PictureOrigin {
  Scene scene;  ///< its meshes where they are now: where they were, or as they lie from the picture
  std::string mesh_hash;
  std::vector<std::string> aovs;
  std::string why_not;  ///< why it cannot be made again; empty: it can
  bool again = false;   ///< it is to be made again, and nothing else is asked for
  /// Camera rays of each pixel of its window, row by row; empty: as many as the scene says.
  std::vector<std::uint32_t> camera_rays;
};

/// Whether the file is named as a picture: the scene is in its attributes.
bool is_picture(const std::filesystem::path& file);

/// The scene in an EXR file's attributes, as a render wrote it. Throws Error(scene) if there is none.
Scene scene_of_picture(const std::filesystem::path& file);
/// All of it.
PictureOrigin origin_of_picture(const std::filesystem::path& file);

/// Throws Error(scene) if the mesh is not the one, by its hash, that the picture was made of.
void check_mesh(const Scene& scene, const std::string& made_of, const std::string& hash);

}  // namespace nook
