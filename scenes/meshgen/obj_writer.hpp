#pragma once

#include <filesystem>
#include <string>

#include "part.hpp"

namespace nook::meshgen {

/// Writes NAME.obj and NAME.mtl into the folder, under a temporary name first. The same model gives the same
/// bytes: fixed notation with six decimals for positions and normals (see Model::exact). Throws
/// std::runtime_error.
void write_obj(const Model& model, const std::filesystem::path& folder, const std::string& name);

}  // namespace nook::meshgen
