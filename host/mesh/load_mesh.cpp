#include "mesh/load_mesh.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "mesh/obj_loader.hpp"
#include "mesh/ply.hpp"
#include "mesh/stl_loader.hpp"
#include "mesh/words.hpp"

namespace nook {
namespace {

using Load = TriangleMesh (*)(const std::filesystem::path&, const MeshAttributes&);

struct Format {
  std::string_view extension;
  Load load;
};

TriangleMesh load_whole_obj(const std::filesystem::path& path, const MeshAttributes& attributes) {
  return load_obj(path, attributes);
}

constexpr Format formats[] = {{".obj", load_whole_obj}, {".ply", load_ply}, {".stl", load_stl}};

constexpr std::string_view unread[] = {
    ".3dm", ".3ds", ".3mf",  ".abc", ".amf",  ".ase",  ".blend", ".c4d",  ".ctm",  ".dae", ".drc", ".dwg",
    ".dxf", ".e57", ".fbx",  ".glb", ".gltf", ".iges", ".igs",   ".las",  ".laz",  ".lwo", ".lws", ".lxo",
    ".ma",  ".max", ".mb",   ".md2", ".md5",  ".mesh", ".msh",   ".nif",  ".off",  ".pcd", ".pts", ".q3o",
    ".skp", ".smd", ".step", ".stp", ".tri",  ".usd",  ".usda",  ".usdc", ".usdz", ".vox", ".vtk", ".vtp",
    ".vtu", ".wrl", ".x",    ".x3d", ".x3db", ".x3dv", ".xyz",   ".zip",  ".bz2",  ".xz",  ".zst", ".7z"};

// That of what a compressed file holds: ".obj" of "a.OBJ.gz".
std::string extension_of(const std::filesystem::path& path) {
  return lower((is_compressed(path) ? path.stem() : path).extension().string());
}

const Format* format_of(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  const auto found = std::find_if(std::begin(formats), std::end(formats),
                                  [&](const Format& f) { return f.extension == extension; });
  return found == std::end(formats) ? nullptr : found;
}

}  // namespace

bool is_compressed(const std::filesystem::path& path) {
  return lower(path.extension().string()) == ".gz";
}

bool is_mesh(const std::filesystem::path& path) {
  return format_of(path) != nullptr;
}

bool is_unread_mesh(const std::filesystem::path& path) {
  if (is_mesh(path)) return false;
  return is_compressed(path) ||
         std::find(std::begin(unread), std::end(unread), extension_of(path)) != std::end(unread);
}

void refuse_format(const std::filesystem::path& path) {
  size_of_input(path);
  throw Error(ErrorKind::scene, Place{path.string()}, "not a format that nook reads (OBJ, PLY, STL)");
}

TriangleMesh load_mesh(const std::filesystem::path& path, const MeshAttributes& attributes) {
  const Format* format = format_of(path);
  if (!format) refuse_format(path);
  return format->load(path, attributes);
}

}  // namespace nook
