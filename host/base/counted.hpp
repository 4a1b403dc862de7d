#pragma once

#include <cstdint>
#include <string>

namespace nook {

/// 1234567 -> "1 234 567".
std::string grouped(std::uint64_t number);

/// "1 triangle", "2 triangles", "12 000 triangles"; `plural` for words that take more than an s ("meshes").
std::string counted(std::uint64_t number, const std::string& word, const std::string& plural = "");

}  // namespace nook
