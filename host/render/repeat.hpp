#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace nook {

/// What makes a picture again, as its attributes have it: `nook render PICTURE.exr` reads them.
struct Repeat {
  std::string scene;  ///< see scene_attribute()
  std::string mesh_hash;
  std::vector<std::string> aovs;  ///< channels that were asked for besides
  std::string why_not;            ///< why it cannot be made again, in a line; empty: it can

  /// "nook/scene" -> ..., "nook/mesh_hash", "nook/aovs", "nook/not_repeatable".
  std::map<std::string, std::string> attributes() const;
};

/// The scene as a picture's attribute: every key, meshes by their absolute paths.
std::string scene_attribute(const Scene& scene);

}  // namespace nook
