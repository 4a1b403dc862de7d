#pragma once

#include <string>

// What the fuzzed program does with the file `path`: each may return or throw nook::Error. std::logic_error
// is a finding: something got through that the device would read without asking.
namespace nook::fuzz {

void read_scene(const std::string& path);
void read_obj_mesh(const std::string& path);
void read_ply_mesh(const std::string& path);
void read_stl_mesh(const std::string& path);
/// An OBJ file compressed by gzip.
void read_compressed_mesh(const std::string& path);
/// The file as the mtllib of a mesh beside it.
void read_materials(const std::string& path);
void read_points(const std::string& path);
/// A checkpoint or shard, once as it is and once with its checksums made right, so that what lies behind them
/// is reached too.
void read_part(const std::string& path);
void read_image(const std::string& path);
/// What `nook study --resume` and `nook deliver` are given.
void read_study(const std::string& path);
void read_delivery_config(const std::string& path);
/// A command line, an argument a line: parsed by nook's own options; what they say is applied to a scene.
void read_command_line(const std::string& path);

}  // namespace nook::fuzz
