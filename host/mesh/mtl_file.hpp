#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A material as its library has it.
struct MtlMaterial {
  Material material;
  std::string fault;  ///< "FILE:LINE: what is wrong with its Ns", or empty: an effect that reads it cannot
};

/// Reads a Wavefront MTL file: of each `newmtl` its name (the rest of the line), Ns, Ks and map_d with the
/// options -s, -o, -mm, -imfchan and -clamp; other options and statements are left out. A material has a lobe
/// if it has an Ns from 0 to 1e7, and no Ks of 0. Throws Error(scene) for a text of UTF-16.
std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path);

/// The regular file that `name` stands for in a file of `folder`, as far as there is one; empty: none. Looked
/// for as it is written (from `folder`), without quotes and escapes, with "/" for "\"; and by its last part
/// in `folder`, of any case: files come with paths of the machine on which they were written.
std::filesystem::path find_beside(const std::filesystem::path& folder, std::string name);

}  // namespace nook
