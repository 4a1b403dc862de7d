#pragma once

#include <filesystem>
#include <fstream>

namespace nook::test {

/// Writes an OBJ: a floor at y = 0 that looks up and a ceiling at y = 1 that looks down, from -25 to 25 along
/// x and z.
inline void write_floor_and_ceiling(const std::filesystem::path& file) {
  std::ofstream obj(file);
  for (const char* height : {"0", "1"})
    obj << "v -25 " << height << " -25\nv 25 " << height << " -25\nv 25 " << height << " 25\nv -25 " << height
        << " 25\n";
  obj << "f 4 3 2 1\nf 5 6 7 8\n";
}

}  // namespace nook::test
