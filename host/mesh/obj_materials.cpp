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
namespace {

// Blanks in a name may be escaped.
std::string unescaped(const std::string& name) {
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (name[i] != '\\' || i + 1 == name.size() || name[i + 1] != ' ') plain += name[i];
  return plain;
}

std::vector<std::filesystem::path> library_files(const std::filesystem::path& folder, std::string line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string::npos) return {};
  line = line.substr(begin, line.find_last_not_of(" \t") + 1 - begin);
  std::vector<std::filesystem::path> files;
  const auto add = [&](const std::string& name) {
    std::error_code code;
    if (std::filesystem::is_regular_file(folder / name, code)) files.push_back(folder / name);
  };
  add(line);
  if (files.empty()) add(unescaped(line));
  if (!files.empty()) return files;
  std::istringstream words(line);
  for (std::string word; words >> word;) add(word);
  return files;
}

}  // namespace

std::uint32_t ObjMaterials::find(const std::string& name) const {
  const auto found = index_of_name.find(name);
  return found == index_of_name.end() ? TriangleMesh::no_material : std::uint32_t(found->second);
}

ObjMaterials load_obj_materials(const std::filesystem::path& folder, const std::vector<std::string>& lines) {
  ObjMaterials result;
  std::vector<tinyobj::material_t> materials;
  std::vector<std::filesystem::path> files;
  std::set<std::string> seen;
  for (const std::string& line : lines) {
    if (!seen.insert(line).second) continue;
    for (const std::filesystem::path& file : library_files(folder, line))
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  }
  for (const std::filesystem::path& path : files) {
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

}  // namespace nook
