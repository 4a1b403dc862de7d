#include "row_kinds.hpp"

namespace nook::test {
namespace {

// A triangle of material `leaf`, in group `sheet`, and an MTL file with that material.
std::vector<std::pair<std::string, std::string>> cut_out(const std::string& map, const std::string& content,
                                                         const std::string& keys = "") {
  return {{"scene.toml", with(with(small_scene, "\"mesh.obj\"", "\"mesh.obj\"\ncutouts = true"), "spp = 4",
                              "spp = 4\n" + keys)},
          {"mesh.obj",
           "mtllib mesh.mtl\n" + triangle + "vt 0 0\nvt 1 0\nvt 0 1\ng sheet\nusemtl leaf\nf 1/1 2/2 3/3\n"},
          {"mesh.mtl", "newmtl leaf\nmap_d " + map + "\n"},
          {"map.png", content}};
}

const std::string signature = "\x89PNG\r\n\x1a\n";

}  // namespace

std::vector<BadInput> effect_rows() {
  const auto keys = [](const std::string& text) { return scene("spp = 4", "spp = 4\n" + text); };
  return {
      {"falloff unknown", render, 3, "unknown falloff 'cubic'", keys("falloff = \"cubic\"")},
      {"falloff without a distance", render, 3, "falloff = \"linear\" needs a max_distance above 0",
       scene("max_distance = 1.0", "max_distance = \"none\"\nfalloff = \"linear\"")},
      {"uniform weight of cosine directions", render, 3,
       "scene.toml:15:10: weight \"uniform\" needs sampling_type hemisphere or sphere",
       keys("sampling_type = \"cosine\"\nweight = \"uniform\"")},
      {"weight of RO", render, 3,
       "unknown key 'weight' in [renderer]: it is one of type ao, bent; RO weighs by its lobe",
       scene("type = \"ao\"", "type = \"ro\"\nweight = \"uniform\"")},
      {"weight of SSAO", render, 3, "SSAO's methods by the cosine alone",
       scene("type = \"ao\"\nspp = 4\nmax_distance = 1.0\n",
             "[[effect]]\ntype = \"ssao\"\nweight = \"uniform\"\n")},
      {"--weight of SSAO", render + " --weight uniform", 2,
       "--weight: scene.toml has no effect of type ao or bent",
       scene("type = \"ao\"\nspp = 4\nmax_distance = 1.0\n", "realtime = true\ntype = \"ssao\"\n")},
      {"min_distance beyond max_distance", render, 3, "min_distance must be below max_distance",
       keys("min_distance = 2.0")},
      {"cone of 0 degrees", render, 3, "cone_angle must be an angle above 0", keys("cone_angle = 0")},
      {"side unknown", render, 3, "unknown side 'outside'", keys("side = \"outside\"")},
      {"occluders of no name", render, 3,
       "occluders must be a list of groups and materials, \"self\" or \"all\"", keys("occluders = []")},
      {"occluders of a number", render, 3, "occluders must be a list", keys("occluders = [1]")},
      {"receivers self", render, 3, "receivers must be a list of groups and materials, or \"all\"",
       keys("receivers = \"self\"")},
      {"occluders of an unknown name",
       render,
       3,
       "occluders: no group or material 'shet' in mesh.obj, did you mean 'sheet'? (groups and materials: "
       "'sheet')",
       {{"scene.toml", with(small_scene, "spp = 4", "spp = 4\noccluders = [\"shet\"]")},
        {"mesh.obj", triangle + "g sheet\nf 1 2 3\n"}}},
      {"probe of occluders self",
       "probe scene.toml --points points.csv",
       3,
       "a probe's points belong to no group",
       {{"scene.toml", with(small_scene, "spp = 4", "spp = 4\noccluders = \"self\"")},
        {"points.csv", "0,0,0,0,0,1\n"}}},
      {"opacity map missing", render, 3, "none.png: no such file", cut_out("none.png", "")},
      {"opacity map that is no PNG", render, 3, "map.png: not a PNG file",
       cut_out("map.png", "GIF89a, not a PNG")},
      {"opacity map truncated", render, 3, "map.png: truncated", cut_out("map.png", signature)},
      {"opacity map is the scene's folder", render, 3, "not a regular file", cut_out(".", "")},
      {"cutouts of a word", render, 3, "cutouts must be true or false",
       scene("\"mesh.obj\"", "\"mesh.obj\"\ncutouts = \"yes\"")},
      {"instancing unknown", render, 3, "unknown instancing 'forest'",
       scene("\"mesh.obj\"", "[\"mesh.obj\"]\ninstancing = \"forest\"")},
      {"instancing of one mesh", render, 3, "instancing needs [[instance]] or a list of meshes",
       scene("\"mesh.obj\"", "\"mesh.obj\"\ninstancing = \"tree\"")},
      {"instancing tree for occluders self",
       render,
       3,
       "instancing = \"tree\": occluders = \"self\" has a tree for each group",
       {{"scene.toml",
         with(with(small_scene, "\"mesh.obj\"", "[\"mesh.obj\", \"mesh.obj\"]\ninstancing = \"tree\""),
              "spp = 4", "spp = 4\noccluders = \"self\"")},
        {"mesh.obj", triangle + "f 1 2 3\n"}}},
      {"instancing tree for SSAO",
       render,
       3,
       "instancing = \"tree\": SSAO draws triangles",
       {{"scene.toml",
         with(with(small_scene, "\"mesh.obj\"", "[\"mesh.obj\", \"mesh.obj\"]\ninstancing = \"tree\""),
              "type = \"ao\"\nspp = 4\nmax_distance = 1.0\n",
              "spp = 4\n[[effect]]\ntype = \"ao\"\n[[effect]]\ntype = \"ssao\"\n")},
        {"mesh.obj", triangle + "f 1 2 3\n"}}},
      {"denoise of a number", render, 3, "denoise must be true or false", keys("denoise = 1")},
      {"--denoise of a share", render + " --denoise --shard 1/2", 2, "a share of a picture is not denoised"},
      {"--denoise of one sample", render + " --denoise --spp 1", 2, "--denoise: needs two samples a pixel"},
      {"--denoise of normals", render + " --denoise", 2, "--denoise: the scene has no effect with samples",
       scene("\"ao\"", "\"normal\"")},
  };
}

}  // namespace nook::test
