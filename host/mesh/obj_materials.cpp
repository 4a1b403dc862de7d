#include "mesh/obj_materials.hpp"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string_view>

#include "mesh/mtl_scan.hpp"

namespace nook {

std::uint32_t ObjMaterials::find(const std::string& name) const {
  const auto found = index_of_name.find(name);
  return found == index_of_name.end() ? 0xffffffffu : std::uint32_t(found->second);
}

ObjMaterials load_obj_materials(const std::filesystem::path& folder,
                                const std::vector<std::string>& libraries) {
  ObjMaterials result;
  std::vector<tinyobj::material_t> materials;
  std::set<std::string> read;
  for (const std::string& name : libraries) {
    if (!read.insert(name).second) continue;
    const std::filesystem::path path = folder / name;
    std::ifstream in(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::set<std::string> with_lobe = materials_with_lobe(text, path.string());
    std::istringstream again(text);
    std::string warnings, errors;
    tinyobj::LoadMtl(&result.index_of_name, &materials, &again, &warnings, &errors);
    for (std::size_t m = result.materials.size(); m < materials.size(); ++m) {
      std::string texture = materials[m].alpha_texname;
      std::replace(texture.begin(), texture.end(), '\\', '/');
      if (!texture.empty()) texture = (path.parent_path() / texture).string();
      const std::string& material = materials[m].name;
      result.materials.push_back(
          {material, with_lobe.contains(material) ? materials[m].shininess : -1.0f, texture});
    }
  }
  return result;
}

void escape_library_names(std::string& text, const std::filesystem::path& folder) {
  const std::string_view key = "mtllib ";
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    if (at > 0 && text[at - 1] != '\n') continue;
    const std::size_t first = text.find_first_not_of(" \t", at + key.size());
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    if (first >= end) continue;
    const std::size_t last = text.find_last_not_of(" \t", end - 1);
    std::string name = text.substr(first, last + 1 - first);
    std::error_code code;
    if (name.find(' ') == std::string::npos || !std::filesystem::is_regular_file(folder / name, code))
      continue;
    for (std::size_t blank = name.find(' '); blank != std::string::npos; blank = name.find(' ', blank + 2))
      name.insert(blank, 1, '\\');
    text.replace(first, last + 1 - first, name);
  }
}

}  // namespace nook
