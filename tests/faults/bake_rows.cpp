#include "row_kinds.hpp"

namespace nook::test {

std::vector<BadInput> bake_rows() {
  const std::string bake = "bake scene.toml --to texture -o out.exr --size 8";
  return {
      {"texture of a mesh without uv", bake, 3, "mesh.obj: no triangle has texture coordinates"},
      {"texture coordinates outside 0 to 1", bake, 3, "(3, 0) of triangle 1 lie outside 0 to 1",
       mesh(triangle + "vt 0 0\nvt 3 0\nvt 0 1\nf 1/1 2/2 3/3\n")},
      {"texture of no known format", "bake scene.toml --to texture -o out.tga", 2,
       "out.tga: a texture is an .exr or a .png"},
      {"PNG of bent normals", "bake scene.toml --to texture -o out.png", 2,
       "out.png: a PNG holds no directions", scene("\"ao\"", "\"bent\"")},
      {"texture of 0 texels", "bake scene.toml --to texture -o out.exr --size 0", 2, "--size"},
      {"texture with a depth", bake + " --aov depth", 2,
       "--aov: a texture has normal, position, variance and samples"},
      {"texels of a bake to vertices", "bake scene.toml -o out.ply --size 64", 2, "they need --to texture"},
      {"bake of reflections", "bake scene.toml -o out.ply", 3, "a bake needs an effect of type ao or bent",
       scene("\"ao\"", "\"ro\"")},
  };
}

}  // namespace nook::test
