#include "bad_input_rows.hpp"

#include <iterator>
#include <sstream>

namespace nook::test {
namespace {

const std::string render = "render scene.toml -o out.exr --no-png --quiet";

std::vector<std::pair<std::string, std::string>> scene(const std::string& part,
                                                       const std::string& replacement) {
  return {{"scene.toml", with(small_scene, part, replacement)}};
}

std::vector<std::pair<std::string, std::string>> mesh(const std::string& text) {
  return {{"mesh.obj", text}};
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::vector<BadInput> scene_rows() {
  return {
      {"no such scene", "render none.toml", 3, "none.toml: no such file"},
      {"scene is a folder", "render folder.toml", 3, "folder.toml: not a regular file", {}, {"folder.toml"}},
      {"scene is a FIFO", "render pipe.toml", 3, "pipe.toml: not a regular file", {}, {}, {"pipe.toml"}},
      {"scene is a device", "render /dev/zero", 3, "/dev/zero: not a regular file"},
      {"scene is empty", render, 3, "scene.toml: objfile is missing in [input]", {{"scene.toml", ""}}},
      {"scene is over 16 MiB", render, 3, "too large", {{"scene.toml", std::string(17 << 20, '#')}}},
      {"scene is truncated in a table", render, 3, "scene.toml:1:", {{"scene.toml", "[input"}}},
      {"scene is truncated in a string",
       render,
       3,
       "scene.toml:2:",
       {{"scene.toml", "[input]\nobjfile = \"mesh"}}},
      {"scene is truncated in an array",
       render,
       3,
       "scene.toml:6:",
       {{"scene.toml", small_scene.substr(0, small_scene.find(", 1.0, 0.0]"))}}},
      {"scene is not UTF-8", render, 3, "scene.toml:1:", {{"scene.toml", "\xff\xfe[input]"}}},
      {"scene is binary",
       render,
       3,
       "scene.toml:1:",
       {{"scene.toml", std::string("\x7f"
                                   "ELF\0\1\2",
                                   7)}}},
      {"scene nests 10000 arrays",
       render,
       3,
       "scene.toml:1:",
       {{"scene.toml", "x = " + std::string(10000, '[')}}},
      {"unknown key", render, 3, "scene.toml:13:1: unknown key 'ssp' in [renderer], did you mean 'spp'?",
       scene("spp = 4", "ssp = 4")},
      {"unknown table", render, 3, "unknown key 'filmm'", scene("[film]", "[filmm]")},
      {"key twice", render, 3, "scene.toml:14:7:", scene("spp = 4\n", "spp = 4\nspp = 5\n")},
      {"unknown renderer type", render, 3, "scene.toml:12:8: unknown type 'amient'",
       scene("\"ao\"", "\"amient\"")},
      {"number as a string", render, 3, "scene.toml:9:9: width must be an integer",
       scene("width = 8", "width = \"8\"")},
      {"width 0", render, 3, "scene.toml:9:9: width must be an integer from 1 to 65535",
       scene("width = 8", "width = 0")},
      {"width 100000", render, 3, "scene.toml:9:9: width must be an integer from 1 to 65535",
       scene("width = 8", "width = 100000")},
      {"height -1", render, 3, "height must be", scene("height = 6", "height = -1")},
      {"film that no memory holds", render + " --size 65535x65535", 4, "GiB"},
      {"fov 0", render, 3, "fov must be an angle above 0 and below 180 degrees",
       scene("fov = 40.0", "fov = 0")},
      {"fov 180", render, 3, "fov must be", scene("fov = 40.0", "fov = 180.0")},
      {"fov NaN", render, 3, "fov must be", scene("fov = 40.0", "fov = nan")},
      {"fov that rounds to 180", render, 3, "fov must be", scene("fov = 40.0", "fov = 179.99999999999")},
      {"fov that rounds to 0", render, 3, "fov must be", scene("fov = 40.0", "fov = 1e-300")},
      {"eye equals at", render, 3, "the camera's eye and at are the same point",
       scene("eye = [0.5, 0.3, 5.0]", "eye = [0, 0, 0]")},
      {"up parallel to the view", render, 3, "up is parallel",
       scene("up = [0.0, 1.0, 0.0]", "up = [0.5, 0.3, 5.0]")},
      {"up is zero", render, 3, "up is zero", scene("up = [0.0, 1.0, 0.0]", "up = [0, 0, 0]")},
      {"eye infinite", render, 3, "eye must be three finite numbers",
       scene("eye = [0.5, 0.3, 5.0]", "eye = [inf, 0, 0]")},
      {"eye beyond float", render, 3, "eye must be three finite numbers",
       scene("eye = [0.5, 0.3, 5.0]", "eye = [1e39, 0, 0]")},
      {"spp 0", render, 3, "spp must be an integer from 1", scene("spp = 4", "spp = 0")},
      {"spp beyond 64 bits", render, 3, "scene.toml:13:", scene("spp = 4", "spp = 99999999999999999999")},
      {"negative distance", render, 3, "max_distance must be",
       scene("max_distance = 1.0", "max_distance = -1.0")},
      {"distance NaN", render, 3, "max_distance must be", scene("max_distance = 1.0", "max_distance = nan")},
      {"crop outside the film", render, 3, "outside the 8x6 film",
       scene("height = 6", "height = 6\ncrop = [0, 9, 0, 6]")},
      {"lobe sampling for AO", render, 3, "needs type \"ro\"",
       scene("spp = 4", "spp = 4\nsampling_type = \"lobe\"")},
  };
}

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

std::vector<BadInput> option_rows() {
  return {
      {"no command", "", 2, "no command was given"},
      {"unknown command", "rendr scene.toml", 2, "rendr"},
      {"no scene named", "render", 2, "scene"},
      {"unknown option", render + " --sp 4", 2, "--sp"},
      {"option without its value", "render scene.toml --spp", 2, "--spp"},
      {"--spp 0", render + " --spp 0", 2, "--spp"},
      {"--spp of a word", render + " --spp many", 2, "--spp"},
      {"--directions over 2^26", render + " --directions 100000000", 2, "--directions"},
      {"--size 0x5", render + " --size 0x5", 2, "--size: '0x5' is not WIDTHxHEIGHT"},
      {"--size of one number", render + " --size 640", 2, "--size"},
      {"--crop of two numbers", render + " --crop 1,2", 2, "--crop"},
      {"--crop empty", render + " --crop 4,4,0,2", 3, "empty or outside"},
      {"--crop left of the film", render + " --crop -1,4,0,2", 3, "empty or outside"},
      {"--error NaN", render + " --error nan", 2, "--error"},
      {"--time NaN", render + " --time nan", 2, "--time"},
      {"--radius of a word", render + " --radius wide", 2, "--radius: 'wide'"},
      {"--sampling unknown", render + " --sampling cosin", 2, "--sampling: unknown value 'cosin'"},
      {"--sampler unknown", render + " --sampler blue", 2, "--sampler: unknown value 'blue'"},
      {"--max-distance -1", render + " --max-distance -1", 2, "--max-distance"},
      {"--exponent NaN", render + " --exponent nan", 2, "--exponent"},
      {"--exponent 1e9", render + " --exponent 1e9", 2, "--exponent"},
      {"--aov unknown", render + " --aov albedo", 2, "--aov: unknown channel 'albedo'"},
      {"--progress unknown", render + " --progress fast", 2, "--progress"},
      {"NOOK_SPP of a word", render, 2, "many", {}, {}, {}, {}, {}, {{"NOOK_SPP", "many"}}},
      {"--resume without a checkpoint", render + " --resume", 2, "--resume: needs --checkpoint"},
      {"--shard 0/4", render + " --shard 0/4", 2, "'0/4' is not I/N"},
      {"--shard 5/4", render + " --shard 5/4", 2, "'5/4' is not I/N"},
      {"--shard of a word", render + " --shard half", 2, "'half' is not I/N"},
      {"--shard slurm outside Slurm", render + " --shard slurm", 2, "SLURM_ARRAY_TASK_ID is not set"},
  };
}

// The drivers' kernel caches are filled first: they write files too.
std::vector<BadInput> output_rows() {
  const std::string warm = render + " --size 256x256";
  const auto remove_first = [](const std::filesystem::path& folder) {
    std::filesystem::remove(folder / "out.exr");
  };
  return {
      {"output folder missing", "render scene.toml -o none/out.exr --quiet", 6,
       "the folder none does not exist"},
      {"output is a folder", "render scene.toml -o folder.exr --quiet", 6, "folder.exr", {}, {"folder.exr"}},
      {"output is the scene", "render scene.toml -o scene.toml --quiet", 6, "would be overwritten"},
      {"output is the mesh", "render scene.toml -o ./mesh.obj --quiet", 6, "would be overwritten"},
      {"outputs share a file", "render scene.toml -o a.exr --stats a.exr --quiet", 2, "cannot share a file"},
      {"output is the preview", "render scene.toml -o a.png --quiet", 2, "a.png: is the preview's name"},
      {"output is a device", "render scene.toml -o /dev/null --quiet", 6, "/dev/null"},
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
       {},
       4096},
      {"disk full at the checkpoint",
       render + " --size 256x256 --checkpoint c.nook",
       6,
       "c.nook: File too large",
       {},
       {},
       {},
       {warm},
       remove_first,
       {},
       4096},
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
       RLIM_INFINITY,
       "/dev/full"},
  };
}

std::vector<BadInput> device_rows() {
  return {
      {"no OpenCL platform",
       render,
       4,
       "no OpenCL device found",
       {},
       {},
       {},
       {},
       {},
       {{"OCL_ICD_VENDORS", "/nonexistent"}}},
      {"no OpenCL loader",
       render,
       4,
       "no OpenCL loader",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", "/nonexistent.so"}}},
      {"device that matches nothing", render + " --device quantum", 4, "no OpenCL device matches 'quantum'"},
      {"device index that is not there", render + " --device 7:7", 4, "no OpenCL device matches '7:7'"},
      {"device out of memory",
       render,
       4,
       "bytes asked",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_ALLOCATION", "1000"}}},
      {"device lost",
       render,
       4,
       "CL_OUT_OF_RESOURCES; nothing was written",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_LAUNCH", "2"}}},
  };
}

std::vector<BadInput> point_rows() {
  const std::string probe = "probe scene.toml --points points.csv --samples 4";
  return {
      {"no such points", "probe scene.toml --points none.csv", 3, "none.csv: no such file"},
      {"points are a folder",
       "probe scene.toml --points folder",
       3,
       "folder: not a regular file",
       {},
       {"folder"}},
      {"points are a FIFO",
       "probe scene.toml --points pipe",
       3,
       "pipe: not a regular file",
       {},
       {},
       {"pipe"}},
      {"point of 5 columns",
       probe,
       3,
       "points.csv:2: 5 columns",
       {{"points.csv", "px,py,pz,nx,ny,nz\n0,0,0,0,1\n"}}},
      {"point NaN",
       probe,
       3,
       "points.csv:1: 'nan' is not a finite number",
       {{"points.csv", "0,nan,0,0,0,1\n"}}},
      {"point beyond float",
       probe,
       3,
       "points.csv:1: '1e39' is not a finite number",
       {{"points.csv", "0,1e39,0,0,0,1\n"}}},
      {"point with a zero normal",
       probe,
       3,
       "points.csv:1: the normal is zero",
       {{"points.csv", "0,0,0,0,0,0\n"}}},
      {"RO point without a view",
       probe + " --effect ro",
       3,
       "points.csv:1: RO needs the view direction",
       {{"points.csv", "0,0,0,0,0,1\n"}}},
  };
}

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
      {"bake of reflections", "bake scene.toml -o out.ply", 3, "a bake needs an effect of type ao or bent",
       scene("\"ao\"", "\"ro\"")},
  };
}

void cut(const std::filesystem::path& file) {
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 100);
}

void flip_at(const std::filesystem::path& file, std::ptrdiff_t from_end) {
  std::string bytes = read_bytes(file);
  bytes[bytes.size() - std::size_t(from_end)] ^= 4;
  write_bytes(file, bytes);
}

std::vector<BadInput> part_rows() {
  const std::string shard = "render scene.toml --quiet --shard ";
  return {
      {"no such part", "merge none.nook -o out.exr", 3, "none.nook: no such file"},
      {"part is a folder", "merge folder -o out.exr", 3, "folder: not a regular file", {}, {"folder"}},
      {"part is no part", "merge mesh.obj -o out.exr", 3, "mesh.obj: not a part of a render"},
      {"part is truncated",
       "merge a.nook -o out.exr",
       3,
       "a.nook: truncated or damaged",
       {},
       {},
       {},
       {shard + "1/2 -o a.nook"},
       [](const auto& f) { cut(f / "a.nook"); }},
      {"part has a flipped bit",
       "merge a.nook -o out.exr",
       3,
       "a.nook: damaged: its checksum is wrong",
       {},
       {},
       {},
       {shard + "1/2 -o a.nook"},
       [](const auto& f) { flip_at(f / "a.nook", 200); }},
      {"part has a flipped bit in its header",
       "merge a.nook -o out.exr",
       3,
       "a.nook: damaged: its header's checksum is wrong",
       {},
       {},
       {},
       {shard + "1/2 -o a.nook"},
       [](const auto& f) {
         flip_at(f / "a.nook", std::ptrdiff_t(std::filesystem::file_size(f / "a.nook")) - 100);
       }},
      {"part claims a header of 4 GB",
       "merge a.nook -o out.exr",
       3,
       "its header does not fit",
       {{"a.nook", std::string("nookpart\1\0\0\0\xff\xff\xff\xff", 16) + std::string(8, 0)}}},
      {"part of a newer format",
       "merge a.nook -o out.exr",
       3,
       "a part of format 2",
       {{"a.nook", std::string("nookpart\2\0\0\0\0\0\0\0", 16) + std::string(8, 0)}}},
      {"parts of other seeds",
       "merge a.nook b.nook -o out.exr",
       3,
       "a.nook and b.nook differ in seed: 0 and 1",
       {},
       {},
       {},
       {shard + "1/2 -o a.nook", shard + "2/2 --seed 1 -o b.nook"}},
      {"parts of other meshes",
       "merge a.nook b.nook -o out.exr",
       3,
       "a.nook and b.nook differ in mesh",
       {{"other.obj", two_squares + "v 9 9 9\nf 1 2 9\n"},
        {"other.toml", with(small_scene, "mesh.obj", "other.obj")}},
       {},
       {},
       {shard + "1/2 -o a.nook", "render other.toml --quiet --shard 2/2 -o b.nook"}},
      {"parts that overlap",
       "merge a.nook b.nook -o out.exr",
       3,
       "b.nook: samples 1 to 1 of",
       {},
       {},
       {},
       {shard + "1/2 -o a.nook", shard + "2/4 -o b.nook"}},
      {"parts are missing",
       "merge a.nook -o out.exr",
       5,
       "50.00 % of the picture is missing: samples 2-3 of 48 pixels",
       {},
       {},
       {},
       {shard + "1/2 -o a.nook"}},
      {"merge without an output", "merge a.nook", 2, "needs -o", {}, {}, {}, {shard + "1/2 -o a.nook"}},
      {"checkpoint of another scene",
       render + " --spp 8 --checkpoint a.nook --resume",
       3,
       "differ in spp: 4 and 8",
       {},
       {},
       {},
       {render.substr(0, 17) + " --quiet --checkpoint a.nook -o first.exr"}},
  };
}

}  // namespace

std::vector<std::string> words(const std::string& command) {
  std::istringstream in(command);
  return {std::istream_iterator<std::string>(in), {}};
}

std::vector<BadInput> bad_input_rows() {
  std::vector<BadInput> all;
  for (const auto& rows : {scene_rows(), mesh_rows(), option_rows(), output_rows(), device_rows(),
                           point_rows(), bake_rows(), part_rows()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

}  // namespace nook::test
