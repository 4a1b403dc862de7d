#include "mesh/obj_materials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "mesh/mtl_file.hpp"
#include "mesh/obj_text.hpp"

namespace nook {
namespace {

std::vector<std::filesystem::path> library_files(const std::filesystem::path& folder,
                                                 const std::string& names, bool& all_there) {
  std::vector<std::filesystem::path> files;
  all_there = true;
  if (const std::filesystem::path whole = find_beside(folder, names); !whole.empty()) return {whole};
  std::string_view words = names;
  for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
    const std::filesystem::path file = find_beside(folder, std::string(word));
    if (!file.empty()) files.push_back(file);
    all_there = all_there && !file.empty();
  }
  return files;
}

// "a" of "a # red".
std::string before_comment(const std::string& name) {
  std::size_t hash = name.find('#');
  while (hash != std::string::npos && (hash == 0 || !is_blank(name[hash - 1])))
    hash = name.find('#', hash + 1);
  return hash == std::string::npos ? name : std::string(trimmed(std::string_view(name).substr(0, hash)));
}

}  // namespace

std::uint32_t ObjMaterials::find(const std::string& name, std::size_t line) {
  auto found = index_of_.find(name);
  if (found == index_of_.end()) found = index_of_.find(before_comment(name));
  if (found == index_of_.end()) {
    const bool known = std::any_of(missing_materials_.begin(), missing_materials_.end(),
                                   [&](const ObjLibrary& m) { return m.names == name; });
    if (!known) missing_materials_.push_back({name, line});
    return TriangleMesh::no_material;
  }
  const auto fault = faults_.find(found->second);
  if (reads_exponents_ && fault != faults_.end()) throw Error(ErrorKind::scene, fault->second);
  return found->second;
}

std::vector<std::string> ObjMaterials::warnings() const {
  const auto line = [&](const std::vector<ObjLibrary>& missing, const char* what) {
    std::string text =
        fmt::format("{}:{}: {} '{}'", file_, missing[0].line, what, missing[0].names.substr(0, 80));
    return missing.size() > 1 ? text + fmt::format(" (nor {} more)", missing.size() - 1) : text;
  };
  if (!reads_any_) return {};
  if (!missing_libraries_.empty()) return {line(missing_libraries_, "there is no material library")};
  if (!missing_materials_.empty()) return {line(missing_materials_, "no library has the material")};
  return {};
}

ObjMaterials load_obj_materials(const std::filesystem::path& obj, const std::vector<ObjLibrary>& libraries,
                                const MeshAttributes& want) {
  ObjMaterials result;
  result.file_ = obj.string();
  result.reads_exponents_ = want.exponents;
  result.reads_any_ = want.exponents || want.uvs;
  std::vector<std::filesystem::path> files;
  for (const ObjLibrary& library : libraries) {
    bool all_there = true;
    for (const std::filesystem::path& file : library_files(obj.parent_path(), library.names, all_there))
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    if (!all_there) result.missing_libraries_.push_back(library);
  }
  for (const std::filesystem::path& file : files)
    for (MtlMaterial& read : read_mtl(file)) {
      const std::uint32_t index = std::uint32_t(result.materials.size());
      const std::string& name = read.material.name;
      result.index_of_.try_emplace(name, index);
      result.index_of_.try_emplace(before_comment(name), index);
      if (!read.fault.empty()) result.faults_[index] = read.fault;
      result.materials.push_back(std::move(read.material));
    }
  return result;
}

}  // namespace nook
