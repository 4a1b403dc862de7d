#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// What follows `mtllib` in a line.
struct ObjLibrary {
  std::string names;
  std::size_t line;
};

/// The materials of an OBJ file's libraries, and what is wrong with them.
class ObjMaterials {
 public:
  std::vector<Material> materials;

  /// The material that `usemtl` names in a line: of several by a name the first; TriangleMesh::no_material if
  /// there is none.
  std::uint32_t find(const std::string& name, std::size_t line);

  /// A line for the first library that is missing, or else for the first material that is in none.
  std::vector<std::string> warnings() const;

 private:
  friend ObjMaterials load_obj_materials(const std::filesystem::path& obj,
                                         const std::vector<ObjLibrary>& libraries,
                                         const MeshAttributes& want);

  std::string file_;  // the OBJ's
  bool reads_exponents_ = false, reads_any_ = false;
  std::map<std::string, std::uint32_t> index_of_;
  std::map<std::uint32_t, std::string> faults_;  // of a material: an exponent that cannot be read
  std::vector<ObjLibrary> missing_libraries_;
  std::vector<ObjLibrary> missing_materials_;  // each name once
};

/// Reads the MTL files that an OBJ file's lines of "mtllib" name, each file once: that of the whole line
/// (names may have blanks in them), or else those of its words; where each is looked for, find_beside() says.
ObjMaterials load_obj_materials(const std::filesystem::path& obj, const std::vector<ObjLibrary>& libraries,
                                const MeshAttributes& want);

}  // namespace nook
