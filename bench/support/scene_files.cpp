#include "bench/support/scene_files.hpp"

#include <fmt/format.h>

#include <fstream>

#include "base/error.hpp"

namespace nook::bench {
namespace {

void write_text(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw Error(ErrorKind::output, path + ": cannot be written");
}

}  // namespace

void write_obj(const std::string& path, const TriangleMesh& mesh) {
  std::string text;
  for (const vec3& p : mesh.positions)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& t : mesh.triangles)
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  write_text(path, text);
}

void write_scene(const std::string& path, const std::string& mesh_file, const BenchScene& scene,
                 const PictureSettings& picture) {
  const auto point = [](const vec3& p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); };
  write_text(path,
             fmt::format("[input]\nobjfile = \"{}\"\n\n[camera]\neye = {}\nat = {}\nup = [0, 1, 0]\n"
                         "fov = {:.1f}\n\n[film]\nwidth = {}\nheight = {}\n\n[renderer]\nrealtime = "
                         "false\ntype = \"ao\"\nsampling_type = \"cosine\"\nmax_distance = \"none\"\nspp "
                         "= {}\ndirections = {}\n",
                         mesh_file, point(scene.eye), point(scene.at), scene.fov, picture.resolution,
                         picture.resolution, picture.spp, picture.directions));
}

}  // namespace nook::bench
