#include "bvh/reinsertion.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "bvh/box4.hpp"

namespace nook {
namespace {

// Measured (bench/journal.md): more of any of these costs more time than it saves rays.
constexpr std::size_t most_subtrees = 1 << 14;  // under the upper tree
constexpr std::size_t moves_a_round = 10000;
constexpr int rounds = 3;
// Places that are looked at for one subtree: some 20 as a rule, and all of them in a soup of long triangles.
constexpr int most_places = 128;
constexpr std::uint32_t none = 0xffffffffu;

// Of a box; where that is beyond the floats' range, their largest.
float area_of(const Box4& box) {
  const float area = box.half_area();
  return area < std::numeric_limits<float>::max() ? area : std::numeric_limits<float>::max();
}

/// The tree's part above subtrees that stay as they are: those are its leaves.
class UpperTree {
 public:
  explicit UpperTree(const BinaryTree& tree) : tree_(tree) {
    // The largest boxes are opened first.
    std::vector<Candidate> largest;
    add(0, none, largest);
    for (std::size_t leaves = 1; leaves < most_subtrees && !largest.empty(); ++leaves) {
      std::pop_heap(largest.begin(), largest.end());
      const std::uint32_t at = largest.back().node, source = nodes_[at].source;
      largest.pop_back();
      nodes_[at].left = add(BinaryTree::left(source), at, largest);
      nodes_[at].right = add(tree_.right(source), at, largest);
    }
  }

  void reinsert() {
    std::vector<Candidate> order;
    for (int round = 0; round < rounds; ++round) {
      order.clear();
      for (std::uint32_t i = 1; i < nodes_.size(); ++i) order.push_back({nodes_[i].area, i});
      const auto end = order.begin() + std::ptrdiff_t(std::min(order.size(), moves_a_round));
      std::partial_sort(order.begin(), end, order.end(),
                        [](const Candidate& a, const Candidate& b) { return b < a; });
      for (auto i = order.begin(); i != end; ++i) move(i->node);
    }
  }

  BinaryTree lay_out(TaskPool& pool) {
    count_pairs();
    BinaryTree made;
    made.nodes.resize(tree_.nodes.size());
    made.pairs.resize(tree_.pairs.size());
    struct Laid {
      std::uint32_t upper, node, first;
    };
    std::vector<Laid> open = {{0, 0, 0}}, subtrees;
    while (!open.empty()) {
      const Laid place = open.back();
      open.pop_back();
      const Node& node = nodes_[place.upper];
      if (node.left == none) {
        subtrees.push_back(place);
        continue;
      }
      const std::uint32_t left_count = nodes_[node.left].count;
      made.nodes[place.node] = {xyz(node.box.lo), xyz(node.box.hi), place.first, node.count, left_count};
      open.push_back({node.right, place.node + 2 * left_count, place.first + left_count});
      open.push_back({node.left, place.node + 1, place.first});
    }
    pool.for_ranges(subtrees.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t source = nodes_[subtrees[i].upper].source, to = subtrees[i].node;
        const BinaryNode& root = tree_.nodes[source];
        const std::uint32_t moved = subtrees[i].first - root.first;
        for (std::uint32_t k = 0; k < 2 * root.count - 1; ++k) {
          made.nodes[to + k] = tree_.nodes[source + k];
          made.nodes[to + k].first += moved;
        }
        std::copy_n(tree_.pairs.begin() + root.first, root.count, made.pairs.begin() + subtrees[i].first);
      }
    });
    return made;
  }

 private:
  struct Node {
    Box4 box;
    float area;
    std::uint32_t parent, left, right;
    std::uint32_t source;  // of tree_.nodes
    std::uint32_t count;   // of pairs
  };
  // By area, and of equal ones in order.
  struct Candidate {
    float area;
    std::uint32_t node;
    bool operator<(const Candidate& o) const { return area < o.area || (area == o.area && node > o.node); }
  };
  // A place for a subtree: what it adds to the areas above, and the node that would become its sibling.
  struct Place {
    float added;
    std::uint32_t node;
    bool operator<(const Place& o) const { return added > o.added || (added == o.added && node > o.node); }
  };

  std::uint32_t add(std::uint32_t source, std::uint32_t parent, std::vector<Candidate>& largest) {
    const BinaryNode& node = tree_.nodes[source];
    const Box4 box = {Float4{node.lo.x, node.lo.y, node.lo.z, 0}, Float4{node.hi.x, node.hi.y, node.hi.z, 0}};
    const auto at = std::uint32_t(nodes_.size());
    nodes_.push_back({box, area_of(box), parent, none, none, source, node.count});
    if (!node.is_leaf()) {
      largest.push_back({nodes_[at].area, at});
      std::push_heap(largest.begin(), largest.end());
    }
    return at;
  }

  static Box4 both(const Box4& a, const Box4& b) {
    Box4 box = a;
    box.add(b);
    return box;
  }

  // The boxes from `at` up, until one is what it was. Returns by how much their areas fell.
  float refit(std::uint32_t at) {
    float fell = 0;
    for (; at != none; at = nodes_[at].parent) {
      Node& node = nodes_[at];
      const Box4 box = both(nodes_[node.left].box, nodes_[node.right].box);
      if (same(box, node.box)) break;
      const float area = area_of(box);
      fell += node.area - area;
      node.box = box;
      node.area = area;
    }
    return fell;
  }

  static bool same(const Box4& a, const Box4& b) {
    const Int4 equal = (a.lo == b.lo) & (a.hi == b.hi);
    return (equal[0] & equal[1] & equal[2]) != 0;
  }

  void replace_child(std::uint32_t parent, std::uint32_t child, std::uint32_t by) {
    Node& node = nodes_[parent];
    (node.left == child ? node.left : node.right) = by;
    nodes_[by].parent = parent;
  }

  void move(std::uint32_t at) {
    const std::uint32_t parent = nodes_[at].parent;
    if (parent == 0) return;  // the root's children stay: their parent would be moved along
    const std::uint32_t above = nodes_[parent].parent,
                        sibling = nodes_[parent].left == at ? nodes_[parent].right : nodes_[parent].left;
    replace_child(above, parent, sibling);
    const float fell = refit(above);
    const std::uint32_t place =
        best_place(at, sibling, fell + area_of(both(nodes_[sibling].box, nodes_[at].box)));
    replace_child(nodes_[place].parent, place, parent);
    nodes_[parent].left = place;
    nodes_[parent].right = at;
    nodes_[place].parent = nodes_[at].parent = parent;
    nodes_[parent].box = both(nodes_[place].box, nodes_[at].box);
    nodes_[parent].area = area_of(nodes_[parent].box);
    refit(nodes_[parent].parent);
  }

  // The place for a subtree that is in no place now: `place`, which adds `best` to the areas, or one that
  // adds less. Branch and bound: a place below a node adds at least what the boxes above it grow by.
  std::uint32_t best_place(std::uint32_t at, std::uint32_t place, float best) {
    const Box4 box = nodes_[at].box;
    const float area = nodes_[at].area;
    places_.assign(1, {0.0f, 0});
    for (int looked_at = 0; !places_.empty() && looked_at < most_places; ++looked_at) {
      std::pop_heap(places_.begin(), places_.end());
      const Place open = places_.back();
      places_.pop_back();
      if (!(open.added + area < best)) break;
      const Node& node = nodes_[open.node];
      const float with = open.added + area_of(both(node.box, box));
      if (with < best && open.node != 0) {
        best = with;
        place = open.node;
      }
      const float below = with - node.area;
      if (node.left == none || !(below + area < best)) continue;
      for (const std::uint32_t child : {node.left, node.right}) {
        places_.push_back({below, child});
        std::push_heap(places_.begin(), places_.end());
      }
    }
    return place;
  }

  void count_pairs() {
    std::vector<std::uint32_t> order = {0};
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Node& node = nodes_[order[i]];
      if (node.left == none) continue;
      order.push_back(node.left);
      order.push_back(node.right);
    }
    for (auto i = order.rbegin(); i != order.rend(); ++i)
      if (Node& node = nodes_[*i]; node.left != none)
        node.count = nodes_[node.left].count + nodes_[node.right].count;
  }

  const BinaryTree& tree_;
  std::vector<Node> nodes_;
  std::vector<Place> places_;
};

}  // namespace

BinaryTree reinsert_subtrees(const BinaryTree& tree, TaskPool& pool) {
  if (tree.empty()) return {};
  UpperTree upper(tree);
  upper.reinsert();
  return upper.lay_out(pool);
}

}  // namespace nook
