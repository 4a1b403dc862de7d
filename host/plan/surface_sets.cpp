#include "plan/surface_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

// The names that faces of a group go by: "a b" of "g a b" goes by a and b as well.
std::vector<std::string_view> names_of_group(const TriangleMesh& mesh, std::size_t group) {
  std::vector<std::string_view> names = {mesh.groups[group]};
  if (!mesh.group_names.empty())
    names.insert(names.end(), mesh.group_names[group].begin(), mesh.group_names[group].end());
  return names;
}

bool share_a_name(const TriangleMesh& mesh, std::size_t a, std::size_t b) {
  if (a == b) return true;
  if (mesh.group_names.empty()) return false;
  const std::vector<std::string_view> of_a = names_of_group(mesh, a), of_b = names_of_group(mesh, b);
  return std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
}

std::vector<std::string_view> known_names(const TriangleMesh& mesh) {
  std::vector<std::string_view> known;
  for (std::size_t g = 0; g < mesh.groups.size(); ++g)
    for (const std::string_view name : names_of_group(mesh, g)) known.push_back(name);
  for (const Material& material : mesh.materials) known.push_back(material.name);
  return known;
}

// "'floor', 'wall', ... (23 more)"
std::string some_of(std::vector<std::string_view> names) {
  std::erase(names, "");
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  if (names.empty()) return "none has a name";
  constexpr std::size_t shown = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
    text += fmt::format("{}'{}'", i ? ", " : "", names[i].substr(0, 40));
  return names.size() > shown ? text + fmt::format(" and {} more", names.size() - shown) : text;
}

}  // namespace

TriangleBits named_triangles(const Scene& scene, const TriangleMesh& mesh, const std::string& key,
                             const std::vector<std::string>& names) {
  const std::vector<std::string_view> known = known_names(mesh);
  std::vector<bool> groups(mesh.groups.size()), materials(mesh.materials.size());
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error(ErrorKind::scene, Place{scene.file.string()},
                  fmt::format("{}: no group or material '{}' in {}{} (groups and materials: {})", key, name,
                              scene.mesh_file.string(), suggestion(name, known), some_of(known)));
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::vector<std::string_view> of_group = names_of_group(mesh, g);
      groups[g] = groups[g] || std::find(of_group.begin(), of_group.end(), name) != of_group.end();
    }
    for (std::size_t m = 0; m < materials.size(); ++m)
      materials[m] = materials[m] || mesh.materials[m].name == name;
  }
  TriangleBits bits((mesh.triangles.size() + 31) / 32);
  const auto in = [](const std::vector<bool>& set, const std::vector<std::uint32_t>& of_triangle,
                     std::size_t t) {
    return !of_triangle.empty() && of_triangle[t] < set.size() && set[of_triangle[t]];
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (in(groups, mesh.triangle_group, t) || in(materials, mesh.triangle_material, t))
      bits[t / 32] |= 1u << (t % 32);
  return bits;
}

std::vector<std::uint32_t> triangles_of(const TriangleBits& bits) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < 32 * bits.size(); ++t)
    if (bits[t / 32] >> (t % 32) & 1) triangles.push_back(t);
  return triangles;
}

namespace {

template <unsigned Width>
GroupTrees group_trees(const TriangleMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> triangles(mesh.groups.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles[mesh.triangle_group[t]].push_back(t);
  GroupTrees made;
  BvhNodes<Width> nodes;
  for (std::size_t g = 0; g < triangles.size(); ++g) {
    std::vector<std::uint32_t> group = triangles[g];
    for (std::size_t other = 0; other < triangles.size() && !mesh.group_names.empty(); ++other)
      if (other != g && share_a_name(mesh, g, other))
        group.insert(group.end(), triangles[other].begin(), triangles[other].end());
    const Bvh tree = build_bvh(mesh, group, {.width = Width});
    const auto& of_group = std::get<BvhNodes<Width>>(tree.nodes);
    made.first.push_back(std::uint32_t(nodes.size()));
    made.first.push_back(std::uint32_t(made.trees.leaves.size()));
    nodes.insert(nodes.end(), of_group.begin(), of_group.end());
    made.trees.leaves.insert(made.trees.leaves.end(), tree.leaves.begin(), tree.leaves.end());
  }
  made.trees.nodes = std::move(nodes);
  return made;
}

}  // namespace

GroupTrees build_group_trees(const TriangleMesh& mesh, unsigned width) {
  return width == 8 ? group_trees<8>(mesh) : group_trees<16>(mesh);
}

}  // namespace nook
