#include "targets.hpp"

#include <zlib.h>

#include <filesystem>
#include <stdexcept>

#include "base/error.hpp"
#include "film/film_part_file.hpp"
#include "image/exr.hpp"
#include "mesh/ply.hpp"
#include "readers.hpp"
#include "support/temporary_folder.hpp"

namespace nook::fuzz {
namespace {

// The bytes of a file as its writer makes it.
template <class Write>
std::string bytes_written(const char* name, Write write) {
  test::TemporaryFolder folder;
  write(folder / name);
  return test::read_bytes(folder / name);
}

std::string seed_part(bool with_surface) {
  FilmPart part;
  part.identity = {{"seed", "7"}};
  part.metadata = {{"nook/seed", "7"}};
  part.layers = {""};
  part.aovs = {"variance", "samples"};
  part.samples_per_pixel = 4;
  part.films = {Film(3, 2, 0x1p32f, 0x1p30f, 2)};
  for (std::uint32_t& n : part.films[0].replicates) n = 2;
  part.held = {{0, 6, 0, 2}};
  part.planned = {{0, 6, 0, 4}};
  if (with_surface) part.surface = {{"Z", std::vector<float>(6, 1.0f)}};
  return bytes_written("a.nook", [&](const auto& path) { write_film_part(path, part); });
}

std::string seed_image() {
  Image image;
  image.width = 5;
  image.height = 3;
  image.channels = {{"R", std::vector<float>(15, 0.5f)}, {"AO.samples", std::vector<std::uint32_t>(15, 7)}};
  image.metadata = {{"nook/seed", "7"}};
  return bytes_written("a.exr", [&](const auto& path) { write_exr(path, image); });
}

std::string seed_ply() {
  TriangleMesh mesh;
  mesh.positions = {vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<vec3> normals(3, vec3(0, 0, 1));
  const std::vector<VertexProperty> properties = {{"ao", {0, 1, 1}}};
  return bytes_written("a.ply", [&](const auto& path) { write_ply(path, mesh, normals, properties); });
}

std::string seed_stl() {
  std::string bytes(80, ' ');
  const std::uint32_t count = 1;
  const float corners[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  return bytes.append(reinterpret_cast<const char*>(corners), sizeof corners) + std::string(2, '\0');
}

std::string seed_gzip(const std::string& text) {
  return bytes_written("a.gz", [&](const std::filesystem::path& path) {
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, text.data(), unsigned(text.size()));
    gzclose(file);
  });
}

std::vector<Target> make_targets() {
  return {
      {"scene",
       "input.toml",
       read_scene,
       {"[input]\nobjfile = \"a.obj\"\n[camera]\neye = [0, 1, 2.5]\nat = [0, 0, 0]\nup = [0, 1, 0]\nfov = "
        "30.0\n[film]\nwidth = 80\nheight = 60\n"
        "crop = [0, 4, 0, 4]\n[renderer]\nrealtime = false\ntype = \"ro\"\nspp = 16\nexponent = "
        "300.0\nmax_distance = \"auto\"\nsampler = \"sobol\"\n",
        "[input]\nobjfile = 'a.obj'\n[renderer]\nrealtime = true\ntype = \"ssao\"\nradius = 0.15\n",
        "input = { objfile = \"\"\"a\"\"\" }\n"},
       {"[input]", "[renderer]", "[[effect]]", "objfile", "= ", "nan", "inf", "-1", "1e400", "\"\"\"", "[[",
        "{", "}", "0x7fffffffffffffff", "1979-05-27T07:32:00Z", "exponent", "material", "\\u00e9"}},
      {"mesh",
       "input.obj",
       read_obj_mesh,
       {"# a\nmtllib none.mtl a.mtl\no a\ng b c\nusemtl m\ns 1\nv 0 0 0\nv 1 0 0 1 1 1\nv 0 1 0\nv 1 1 "
        "1e3\nvt 0 "
        "0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3//1\nf -1 -2 -3 -4\nl 1 2\n",
        "v nan 0 0\nv inf 1 1\nv 1 2 3\nvn 0 0 0\nf 1 2 3\n",
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3 \\\r\n",
        "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 1 1 0\nv 1 2 0\nv 3 2 0\nv 3 3 0\nv 0 3 0\nv 1 2.2 0\nv 2 2.2 0\nv 2 "
        "2.8 0\n"
        "v 1 2.8 0\nf 1 2 3 4 5 6 7 8 12 11 10 9 12 8\nf 1 2 3 4 \\\n5 6 7 8\nf 1 3 2 8\n"},
       {"v ",    "vn ",  "vt ", "f ",         "l ",         "p ",         "usemtl ", "mtllib ",
        "//",    "/",    "-",   "1000000000", "2147483648", "4294967297", "nan",     "inf",
        "1e999", "\\\n", "g ",  "o ",         "t ",         "vw ",        "#"}},
      {"ply",
       "input.ply",
       read_ply_mesh,
       {seed_ply(),
        "ply\nformat ascii 1.0\ncomment a\nelement vertex 3\nproperty float x\nproperty double y\nproperty "
        "float z\nproperty uchar red\nelement face 2\nproperty list uchar int vertex_indices\nproperty int "
        "a\nend_header\n0 0 0 255\n1 0 0 1\n0 1 0 2\n3 0 1 2 7\n4 0 1 2 1 8\n",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
        "z\nproperty "
        "float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_index\nproperty list "
        "uchar float "
        "texcoord\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 "
        "0\n"
        "1 1 0 1 1\n0 1 0 +0 1\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n7 0 1 2 -1 0 1 3\n"},
       {"ply\n",
        "format ",
        "binary_little_endian 1.0\n",
        "binary_big_endian 1.0\n",
        "tristrips ",
        "texcoord\n",
        "int64 ",
        "uint64 ",
        "element vertex ",
        "element face ",
        "property ",
        "list ",
        "uchar ",
        "char ",
        "ushort ",
        "int ",
        "float32 ",
        "double ",
        "x\n",
        "nx\n",
        "vertex_indices\n",
        "end_header\n",
        "4294967295",
        "-1"}},
      {"stl",
       "input.stl",
       read_stl_mesh,
       {seed_stl(),
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 0\nendloop\n"
        "endfacet\nendsolid a\n"},
       {"solid ", "facet ", "normal ", "outer loop\n", "vertex ", "endloop\n", "endfacet\n", "endsolid\n",
        std::string("\1\0\0\0", 4), "\xff\xff\xff\xff", "nan"}},
      {"compressed",
       "input.obj.gz",
       read_compressed_mesh,
       {seed_gzip("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")},
       {"\x1f\x8b\x08", std::string("\0\0\xff\xff", 4), "f 1 2 3\n"}},
      {"materials",
       "input.mtl",
       read_materials,
       {"newmtl a\nKd 1 0 0\nNs 30\nmap_d -bm 1 a.png\nd 0.5\nTr 0.1\nillum 2\n",
        "newmtl a\nnewmtl a\nNs nan\n"},
       {"newmtl ", "Ns ", "map_d ", "map_Kd ", "-mm ", "-o ", "-type ", "Kd ", "1e999", "nan", "refl ",
        "norm ", "Pr ", "aniso "}},
      {"points",
       "input.csv",
       read_points,
       {"px,py,pz,nx,ny,nz,vx,vy,vz\n0,0,0,0,0,1,0,0,1\n# a\n\n1 2 3 0 1 0 1 0 0\n", "0,0,0,0,0,1\n"},
       {"nan", "inf", "1e39", "-0", ",,", "#", "\r\n", "\t", "+", "1e-400"}},
      {"part",
       "input.nook",
       read_part,
       {seed_part(false), seed_part(true)},
       {"nookpart", "\"width\":", "65535", "4294967295", "null", "[]", "{}", "-1"}},
      {"image",
       "input.exr",
       read_image,
       {seed_image()},
       {"channels", "dataWindow", "compression", "tiledesc", "float", std::string(4, '\xff'),
        std::string(4, '\0'), "\x7f"}},
      {"study",
       "input.json",
       read_study,
       {"{\"facts\":[{\"name\":\"scene\",\"text\":\"a.toml\"}],\"runs\":[{\"method\":\"a\",\"level\":4,"
        "\"bias_square\":0,\"pairs\":1,\"runs\":[{\"seed\":1,\"wall_seconds\":0.5,\"device_seconds\":0.4,"
        "\"rays\":9,\"mse\":1e-4,\"mean_error\":0,\"covered\":0.9,\"error_claimed\":0.01}]}]}"},
       {"null", "[[", "{}", "-1", "1e999", "\"\"", "\"runs\":", "\\ud800", "true"}},
      {"delivery",
       "config.json",
       read_delivery_config,
       {"{\"firstlast\":\"A B\",\"id\":1,\"course\":2,\"assignment\":3,\"renders\":[{\"scene\":\"s\","
        "\"render\":\"offline/a.exr\"}]}"},
       {"null", "[[", "{}", "-1", "18446744073709551616", "\"\"", "../", "realtime/", ".exr", "\\ud800"}},
      {"command",
       "arguments",
       read_command_line,
       {"render\na.toml\n--spp\n16\n--size=80x60\n--crop\n0,4,0,4\n--max-distance\n1.5\n--error\n0.01\n",
        "a.toml\n--spp\n16\n--size=80x60\n--crop\n0,4,0,4\n--max-distance\n1.5\n--exponent\n30\n",
        "a.toml\n--sampling\nlobe\n--sampler\nhalton\n--shard\n2/8\n--time\n3\n--radius\nauto\n",
        "probe\na.toml\n--points\na.csv\n--effect\nro\n", "compare\na.exr\nb.exr\n", "merge\na\n-o\nb\n"},
       {"--spp\n",
        "--directions\n",
        "--seed\n",
        "--size=",
        "--crop=",
        "--error\n",
        "--confidence\n",
        "--min-spp=",
        "--checkpoint\n",
        "--every=",
        "--resume\n",
        "--shard=",
        "slurm",
        "--threads=",
        "--device\n",
        "--quality\n",
        "--method=",
        "--help\n",
        "--aov=",
        "--\n",
        "nan",
        "inf",
        "1e39",
        "-1",
        "99999999999999999999"}},
  };
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = make_targets();
  return all;
}

void run_once(const Target& target, const std::string& input) {
  static const test::TemporaryFolder folder;
  const std::string path = (folder / target.file).string();
  std::filesystem::remove(path);  // a file cut to nothing and written again is flushed to the disk by ext4
  test::write_bytes(path, input);
  try {
    target.read(path);
  } catch (const Error& error) {
    const std::string message = error.what();
    if (target.read == read_command_line && error.kind() == ErrorKind::usage) return;  // quotes arguments
    if (error.kind() != ErrorKind::scene) throw std::logic_error("exit code of: " + message);
    if (message.empty() || message.find('\n') != std::string::npos)
      throw std::logic_error("not one line: " + message);
    if (message.size() > 2000) throw std::logic_error("too long a line: " + message.substr(0, 200));
  }
}

}  // namespace nook::fuzz
