#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// The materials of an OBJ file's libraries.
struct ObjMaterials {
  std::vector<Material> materials;
  std::map<std::string, int> index_of_name;  ///< into `materials`: of several by a name, the first

  /// 0xffffffff if there is none.
  std::uint32_t find(const std::string& name) const;
};

/// Reads MTL files of `folder`, each once. Throws Error(scene) for an Ns that is none (mtl_scan.hpp).
ObjMaterials load_obj_materials(const std::filesystem::path& folder,
                                const std::vector<std::string>& libraries);

/// A material library may have blanks in its name; tinyobjloader takes what they part for several libraries,
/// unless they are escaped. They are, where the whole is a file of `folder`.
void escape_library_names(std::string& text, const std::filesystem::path& folder);

}  // namespace nook
