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

  /// TriangleMesh::no_material if there is none.
  std::uint32_t find(const std::string& name) const;
};

/// Reads the MTL files of `folder` that lines of "mtllib" name, each file once: that of the whole line (names
/// may have blanks in them), or else those of its words. A name that is no regular file is left unread.
/// Throws Error(scene) for an Ns that is none (mtl_scan.hpp).
ObjMaterials load_obj_materials(const std::filesystem::path& folder, const std::vector<std::string>& lines);

}  // namespace nook
