#include "plan/subject_points.hpp"

namespace nook {
namespace {

// Neighbours in a file are mostly neighbours in space.
constexpr std::uint32_t triangles_a_block = 256;

}  // namespace

SubjectPoints::SubjectPoints(const TriangleMesh& mesh) : mesh_(mesh) {
  const bool on_ground = !mesh.subject.empty();
  if (mesh.instances.empty()) {
    add_blocks(0, std::uint32_t(mesh.triangles.size()) - (on_ground ? 2u : 0u));
    groups_ = {{0, blocks_.size(), nullptr}};
    return;
  }
  std::vector<std::size_t> first{0};
  for (const TriangleMesh::Model& model : mesh.models) {
    add_blocks(model.first_triangle, model.triangles);
    first.push_back(blocks_.size());
  }
  for (std::size_t i = 0; i + (on_ground ? 1 : 0) < mesh.instances.size(); ++i) {
    const TriangleMesh::Instance& instance = mesh.instances[i];
    groups_.push_back({first[instance.model], first[instance.model + 1], &instance.place});
  }
}

void SubjectPoints::add_blocks(std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t begin = first; begin < first + count; begin += triangles_a_block) {
    Block block{begin, std::min(begin + triangles_a_block, first + count), {}};
    for (std::uint32_t t = block.first; t < block.end; ++t)
      for (const std::uint32_t i : mesh_.triangles[t]) block.bounds.add(mesh_.positions[i]);
    blocks_.push_back(block);
  }
}

}  // namespace nook
