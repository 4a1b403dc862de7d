#include "row_kinds.hpp"

namespace nook::test {

namespace {

void cut(const std::filesystem::path& file) {
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 100);
}

void flip_at(const std::filesystem::path& file, std::ptrdiff_t from_end) {
  std::string bytes = read_bytes(file);
  bytes[bytes.size() - std::size_t(from_end)] ^= 4;
  write_bytes(file, bytes);
}

}  // namespace

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
       {{"a.nook", std::string("nookpart\2\0\0\0\xff\xff\xff\xff", 16) + std::string(8, 0)}}},
      {"part of a newer format",
       "merge a.nook -o out.exr",
       3,
       "a part of format 3",
       {{"a.nook", std::string("nookpart\3\0\0\0\0\0\0\0", 16) + std::string(8, 0)}}},
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
      {"parts of other materials",
       "merge a.nook b.nook -o out.exr",
       3,
       "a.nook and b.nook differ in mesh",
       {{"scene.toml", with(small_scene, "type = \"ao\"", "type = \"ro\"\nexponent = \"material\"")},
        {"mesh.obj", "mtllib mesh.mtl\nusemtl shiny\n" + two_squares},
        {"mesh.mtl", "newmtl shiny\nKs 1 1 1\nNs 30\n"},
        {"other.obj", "mtllib other.mtl\nusemtl shiny\n" + two_squares},
        {"other.mtl", "newmtl shiny\nKs 1 1 1\nNs 300\n"},
        {"other.toml", with(with(small_scene, "type = \"ao\"", "type = \"ro\"\nexponent = \"material\""),
                            "mesh.obj", "other.obj")}},
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
      {"checkpoint of another error",
       render + " --error .2 --checkpoint a.nook --resume",
       3,
       "differ in error: 0.1 and 0.2",
       {},
       {},
       {},
       {render.substr(0, 17) + " --quiet --error .1 --checkpoint a.nook -o first.exr"}},
      {"merge of a render to an error",
       "merge a.nook -o out.exr",
       2,
       "a.nook: a render to an error; nook render --resume makes its picture",
       {},
       {},
       {},
       {render.substr(0, 17) + " --quiet --error .1 --checkpoint a.nook -o first.exr"}},
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

}  // namespace nook::test
