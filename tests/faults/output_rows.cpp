#include <cstdlib>

#include "row_kinds.hpp"

namespace nook::test {

// The drivers' kernel caches are filled first: they write files too.
std::vector<BadInput> output_rows() {
  const std::string warm = render + " --size 256x256";
  const auto remove_first = [](const std::filesystem::path& folder) {
    std::filesystem::remove(folder / "out.exr");
  };
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const std::vector<std::pair<std::string, std::string>> pocl_writes_nothing = {
      {"POCL_CACHE_DIR", std::string(cache ? cache : "/tmp") + "/pocl-of-full-disks"}};
  return {
      {"output folder missing", "render scene.toml -o none/out.exr --quiet", 6,
       "the folder none does not exist"},
      {"output is a folder", "render scene.toml -o folder.exr --quiet", 6, "folder.exr", {}, {"folder.exr"}},
      {"output is the scene", "render scene.toml -o scene.toml --quiet", 6, "would be overwritten"},
      {"output is the mesh", "render scene.toml -o ./mesh.obj --quiet", 6, "would be overwritten"},
      {"outputs share a file", "render scene.toml -o a.exr --stats a.exr --quiet", 2, "cannot share a file"},
      {"output is the preview", "render scene.toml -o a.png --quiet", 2, "a.png: is the preview's name"},
      {"output is a device", "render scene.toml -o /dev/null --quiet", 6, "/dev/null"},
      {"output is a full device", "render scene.toml -o /dev/full --quiet", 6,
       "/dev/full: not a regular file"},
      {"output folder not writable", "render scene.toml -o /proc/out.exr --quiet", 6, "/proc/out.exr"},
      {"output name too long", "render scene.toml --quiet -o " + std::string(300, 'x') + ".exr", 6,
       "File name too long"},
      {"disk full at the picture",
       render + " --size 256x256",
       6,
       "out.exr: File too large",
       {},
       {},
       {},
       {warm},
       remove_first,
       pocl_writes_nothing,
       {{RLIMIT_FSIZE, 4096}}},
      {"disk full at the checkpoint",
       render + " --size 256x256 --checkpoint c.nook",
       6,
       "c.nook: File too large",
       {},
       {},
       {},
       {warm},
       remove_first,
       pocl_writes_nothing,
       {{RLIMIT_FSIZE, 4096}}},
      {"disk full at PoCL's files",
       render + " --size 256x256",
       6,
       "pocl: File too large: PoCL has no room",
       {},
       {},
       {},
       {warm},
       remove_first,
       {},
       {{RLIMIT_FSIZE, 4096}}},
      {"picture of a format that is not written", "render scene.toml -o z.jpg --quiet", 2,
       "z.jpg: not a format that is written here (.exr)"},
      {"merged picture of a format that is not written", "merge a.nook -o z.tif", 2,
       "z.tif: not a format that is written here (.exr, .nook)"},
      {"error image of a format that is not written", "compare a.exr b.exr --error-image z.jpg", 2,
       "z.jpg: not a format that is written here (.png, .exr)"},
      {"bake to vertices of a format that is not written", "bake scene.toml -o z.obj", 2,
       "z.obj: not a format that is written here (.ply)"},
      {"--stats folder missing", render + " --stats none/stats.json", 6, "none"},
      {"--checkpoint folder missing", render + " --checkpoint none/c.nook", 6, "none"},
      {"checkpoint exists", render + " --checkpoint c.nook", 2, "c.nook exists", {{"c.nook", "x"}}},
      {"stdout full",
       "probe scene.toml --points points.csv",
       6,
       "stdout",
       {{"points.csv", "0,0,0,0,0,1\n"}},
       {},
       {},
       {},
       {},
       {},
       {},
       "/dev/full"},
  };
}

}  // namespace nook::test
