#include "mesh/obj_piece.hpp"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <istream>
#include <limits>
#include <streambuf>

namespace nook {
namespace {

// A stream over memory, without copying it; nothing is put back into it.
struct MemoryBuffer : std::streambuf {
  explicit MemoryBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());
    setg(begin, begin, begin + text.size());
  }
};

struct Reader {
  ObjPiece& piece;
  TriangleMesh& mesh;
  const ObjCounts& all;
  ObjCounts so_far;  // in the whole text
  bool good = true;

  static Reader& of(void* self) { return *static_cast<Reader*>(self); }

  // Elements beyond those that the scan counted would be another piece's.
  template <class T>
  void element(std::vector<T>& values, std::size_t ObjCounts::*kind, const T& value) {
    if (so_far.*kind == piece.before.*kind + piece.scan.counts.*kind) {
      good = false;
      return;
    }
    if (!values.empty()) values[so_far.*kind] = value;
    ++(so_far.*kind);
  }

  // From what a file says, 1-based or, if negative, back from the last one above, to 0-based or, for 0, -1.
  int resolved(int index, std::size_t ObjCounts::*kind) {
    if (index == 0) return -1;
    const std::int64_t at = index > 0 ? index - 1 : std::int64_t(so_far.*kind) + index;
    good = good && at >= 0 && at < std::int64_t(all.*kind);
    return int(at);
  }

  void face(const tinyobj::index_t* corners, int count) {
    // A comment behind a face reads as corners whose position is 0, which the scan has found in no corner.
    int size = 0;
    while (size < count && corners[size].vertex_index != 0) ++size;
    const bool kept = size >= 3;
    for (int k = 0; k < size; ++k) {
      const ObjCorner corner = {resolved(corners[k].vertex_index, &ObjCounts::positions),
                                resolved(corners[k].texcoord_index, &ObjCounts::uvs),
                                resolved(corners[k].normal_index, &ObjCounts::normals)};
      if (kept) piece.corners.push_back(corner);
    }
    if (kept) piece.face_sizes.push_back(std::uint32_t(size));
  }

  void change(bool material, std::string name) {
    piece.changes.push_back({piece.face_sizes.size(), material, std::move(name)});
  }
};

// Several names of a group are one, with blanks.
std::string joined(const char** names, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) {
    if (i) all += ' ';
    all += names[i];
  }
  return all;
}

std::string first_word(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  return std::string(text.substr(begin, text.find_first_of(" \t\r", begin) - begin));
}

tinyobj::callback_t callbacks() {
  using tinyobj::real_t;
  tinyobj::callback_t call;
  call.vertex_cb = [](void* self, real_t x, real_t y, real_t z, real_t) {
    Reader& reader = Reader::of(self);
    reader.element(reader.mesh.positions, &ObjCounts::positions, vec3(x, y, z));
  };
  call.normal_cb = [](void* self, real_t x, real_t y, real_t z) {
    Reader& reader = Reader::of(self);
    reader.element(reader.mesh.normals, &ObjCounts::normals, vec3(x, y, z));
  };
  call.texcoord_cb = [](void* self, real_t u, real_t v, real_t) {
    Reader& reader = Reader::of(self);
    reader.element(reader.mesh.uvs, &ObjCounts::uvs, vec2(u, v));
  };
  call.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
    Reader::of(self).face(corners, count);
  };
  // A `usemtl` without a name, which tinyobjloader does not report, changes nothing.
  call.usemtl_cb = [](void* self, const char* name, int) { Reader::of(self).change(true, first_word(name)); };
  call.group_cb = [](void* self, const char** names, int count) {
    Reader::of(self).change(false, joined(names, count));
  };
  call.object_cb = [](void* self, const char* name) { Reader::of(self).change(false, name); };
  return call;
}

}  // namespace

bool read_obj_piece(ObjPiece& piece, const ObjCounts& all, TriangleMesh& mesh) {
  piece.corners.reserve(3 * piece.scan.counts.faces);
  piece.face_sizes.reserve(piece.scan.counts.faces);
  Reader reader{piece, mesh, all, piece.before};
  MemoryBuffer buffer(piece.text);
  std::istream in(&buffer);
  std::string warnings, errors;
  const bool parsed = tinyobj::LoadObjWithCallback(in, callbacks(), &reader, nullptr, &warnings, &errors);
  const auto all_read = [&](std::size_t ObjCounts::*kind) {
    return reader.so_far.*kind == piece.before.*kind + piece.scan.counts.*kind;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  if (!mesh.normals.empty())
    for (std::uint32_t i : piece.scan.non_finite_normals) mesh.normals[piece.before.normals + i].x = nan;
  return parsed && reader.good && all_read(&ObjCounts::positions) && all_read(&ObjCounts::uvs) &&
         all_read(&ObjCounts::normals);
}

}  // namespace nook
