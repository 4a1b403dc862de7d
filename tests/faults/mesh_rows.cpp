#include "row_kinds.hpp"

namespace nook::test {

std::vector<BadInput> mesh_rows() {
  return {
      {"no such mesh", render, 3, "none.obj: no such file", scene("mesh.obj", "none.obj")},
      {"mesh is a folder",
       render,
       3,
       "folder.obj: not a regular file",
       scene("mesh.obj", "folder.obj"),
       {"folder.obj"}},
      {"mesh is a FIFO",
       render,
       3,
       "pipe.obj: not a regular file",
       scene("mesh.obj", "pipe.obj"),
       {},
       {"pipe.obj"}},
      {"mesh is a device", render, 3, "/dev/zero: not a regular file", scene("mesh.obj", "/dev/zero")},
      {"mesh name is empty", render, 3, "scene.toml:2:11: objfile must be the name of a mesh",
       scene("mesh.obj", "")},
      {"mesh name is very long", render, 3, "no such file", scene("mesh.obj", std::string(300, 'x'))},
      {"mesh outside the folder that is no mesh", render, 3, "no triangles",
       scene("mesh.obj", "../../../../../../../etc/hostname")},
      {"mesh is empty", render, 3, "mesh.obj: the mesh has no triangles", mesh("")},
      {"mesh without faces", render, 3, "mesh.obj: the mesh has no triangles", mesh(triangle)},
      {"mesh is binary", render, 3, "mesh.obj",
       mesh(std::string("\x7f"
                        "ELF\0\1\2\n\0f 1 2 3\n",
                        17))},
      {"face index out of range", render, 3, "mesh.obj:4: face index 4 is out of range (3 positions so far)",
       mesh(triangle + "f 1 2 4\n")},
      {"face index 0", render, 3, "mesh.obj:4: face index 0 is out of range", mesh(triangle + "f 0 1 2\n")},
      {"face index too negative", render, 3, "mesh.obj:4: face index -4 is out of range",
       mesh(triangle + "f -4 -1 -2\n")},
      {"face index beyond 32 bits", render, 3, "mesh.obj:4: face index 4294967297 is out of range",
       mesh(triangle + "f 4294967297 2 3\n")},
      {"face index 1000000000", render, 3, "mesh.obj:4: face index 1000000000 is out of range",
       mesh(triangle + "f 1 2 1000000000\n")},
      {"face index is a word", render, 3, "mesh.obj:4: face index 'a' is not an integer",
       mesh(triangle + "f a b c\n")},
      {"normal index out of range", render, 3, "mesh.obj:4: face index 9 is out of range",
       mesh(triangle + "f 1//9 2//9 3//9\n")},
      {"face of two corners", render, 3, "no triangles", mesh(triangle + "f 1 2\n")},
      {"vertex is a word", render, 3, "mesh.obj:1:", mesh("v x y z\nf 1 1 1\n")},
      {"vertex of two numbers", render, 3, "mesh.obj:1: 2 numbers, expected 3",
       mesh("v 1 2\nv 0 0 0\nv 1 0 0\nf 1 2 3\n")},
      {"all vertices NaN", render, 3, "no triangle is left (1 have NaN or infinite vertices)",
       mesh("v nan 0 0\nv 1 nan 0\nv 0 1 inf\nf 1 2 3\n")},
      {"vertices beyond float", render, 3, "no triangle is left",
       mesh("v 1e39 0 0\nv 1 1e300 0\nv 0 1 -1e39\nf 1 2 3\n")},
  };
}

}  // namespace nook::test
