#pragma once

#include <set>
#include <string>
#include <string_view>

namespace nook {

/// The materials of an MTL text that have a lobe: an Ns, and no Ks of 0 0 0. (tinyobjloader does not tell
/// whether an Ns was there.) Throws Error(scene) "<name>:<line>: ..." for an Ns that is not a number from 0
/// to 1e7.
std::set<std::string> materials_with_lobe(std::string_view text, const std::string& name);

}  // namespace nook
