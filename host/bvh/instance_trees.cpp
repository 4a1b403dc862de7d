#include "bvh/instance_trees.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/instance.hpp"

namespace nook {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(),
                largest = std::numeric_limits<float>::max();

// The world's box of a placed model: of the boxes of its root's children, for they lie closer than the
// root's. Grown by an ulp as theirs are, and finite as its vertices are.
template <unsigned Width>
Bounds3 box_of(const PlacedMesh& place, const BvhNode<Width>& root) {
  Bounds3 box;
  for (int lane = 0; lane < int(BVH_CHILDREN(&root)); ++lane) {
    Bounds3 child;
    for (int axis = 0; axis < 3; ++axis) {
      child.lo[axis] = root.lo[axis][lane];
      child.hi[axis] = root.hi[axis][lane];
    }
    box.add(placed_bounds(place, child));
  }
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::max(std::nextafter(box.lo[axis], -infinity), -largest);
    box.hi[axis] = std::min(std::nextafter(box.hi[axis], infinity), largest);
  }
  return box;
}

// The tree over boxes: each is a triangle between two of its corners and a third, which has the box's bounds.
// No two are a pair: the lower corner of each would be as high as the upper corner of the other.
Bvh tree_over(const std::vector<Bounds3>& boxes, const std::vector<nook_uint>& names,
              const BvhOptions& options) {
  TriangleMesh stand_ins;
  for (const Bounds3& box : boxes) {
    const auto first = std::uint32_t(stand_ins.positions.size());
    for (const vec3& corner : {box.lo, box.hi, vec3(box.lo.x, box.hi.y, box.lo.z)})
      stand_ins.positions.push_back(corner);
    stand_ins.triangles.push_back({first, first + 1, first + 2});
  }
  Bvh bvh = build_bvh(stand_ins, options);
  rename_triangles(bvh, names);
  return bvh;
}

// Appends a tree and says where its root is; what it had is freed.
template <unsigned Width>
nook_uint append_tree(Bvh& whole, Bvh&& model) {
  auto &nodes = std::get<BvhNodes<Width>>(whole.nodes), &more = std::get<BvhNodes<Width>>(model.nodes);
  const auto first_node = nook_uint(nodes.size()), first_leaf = nook_uint(whole.leaves.size());
  check_bvh_size(nodes.size() + more.size(), whole.leaves.size() + model.leaves.size());
  for (BvhNode<Width> node : more) {
    node.nodes += first_node;
    node.leaves += first_leaf;
    nodes.push_back(node);
  }
  whole.leaves.insert(whole.leaves.end(), model.leaves.begin(), model.leaves.end());
  model = {};
  return first_node;
}

template <unsigned Width>
Bvh join(const TriangleMesh& mesh, std::vector<Bvh> models, const BvhOptions& options) {
  std::vector<Bounds3> boxes;
  std::vector<nook_uint> names;
  for (std::size_t i = 0; i < mesh.instances.size(); ++i) {
    const TriangleMesh::Instance& instance = mesh.instances[i];
    const BvhNode<Width>& root = std::get<BvhNodes<Width>>(models[instance.model].nodes).front();
    if (BVH_CHILDREN(&root) == 0) continue;
    boxes.push_back(box_of(instance.place, root));
    names.push_back(nook_uint(i));
  }
  Bvh whole = tree_over(boxes, names, options);
  Bvh::Statistics& all = whole.statistics;
  std::vector<nook_uint> roots;
  unsigned deepest = 0;
  std::size_t leaves = 0, filled = 0;
  for (Bvh& model : models) {
    all.build_seconds += model.statistics.build_seconds;
    all.collapse_seconds += model.statistics.collapse_seconds;
    all.sah_cost += model.statistics.sah_cost;
    deepest = std::max(deepest, model.statistics.depth);
    leaves += model.leaves.size();
    filled += std::size_t(model.statistics.triangles_per_leaf * double(model.leaves.size()) + 0.5);
    roots.push_back(append_tree<Width>(whole, std::move(model)));
  }
  all.depth += deepest;
  all.triangles_per_leaf = double(filled) / double(leaves);
  for (const TriangleMesh::Instance& instance : mesh.instances) {
    PlacedMesh place = instance.place;
    place.root = roots[instance.model];
    place.meshes = nook_uint(mesh.instances.size());
    whole.instances.push_back(place);
  }
  return whole;
}

}  // namespace

void rename_triangles(Bvh& bvh, std::span<const nook_uint> names) {
  for (TriangleLeaf& leaf : bvh.leaves)
    for (nook_uint& name : leaf.triangle)
      if (name != BVH_EMPTY) name = names[name];
}

Bvh join_trees(const TriangleMesh& mesh, std::vector<Bvh> models, const BvhOptions& options) {
  return options.width == 8 ? join<8>(mesh, std::move(models), options)
                            : join<16>(mesh, std::move(models), options);
}

}  // namespace nook
