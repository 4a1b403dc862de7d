// One ray at a time through the trees of placed meshes (placed_tree.cl), a child at a time: as traverse_scalar.cl, with the placed mesh
// beside each stack entry.
#ifndef NOOK_TRAVERSE_INSTANCES_SCALAR_CL
#define NOOK_TRAVERSE_INSTANCES_SCALAR_CL

#include "trace/insertion.cl"
#include "trace/intersect.cl"
#include "trace/leaf_holes.cl"
#include "trace/placed_tree.cl"

#if INSTANCES

// placed_planes() for one child.
float placed_plane(__global const BvhNode* node, uint lane, __global const float* row, bool upper) {
  const float x = (row[0] < 0.0f) != upper ? node->hi[0][lane] : node->lo[0][lane];
  const float y = (row[1] < 0.0f) != upper ? node->hi[1][lane] : node->lo[1][lane];
  const float z = (row[2] < 0.0f) != upper ? node->hi[2][lane] : node->lo[2][lane];
  const float bound = PLACED(row, x, y, z);
  const float growth = fma(fabs(bound), 0x1p-23f, 0x1p-126f);
  return upper ? bound + growth : bound - growth;
}

// A child of an item that is not a leaf of triangles: its box in the world; false if the lane has none. open_node() for one child.
bool open_child(__global const BvhNode* nodes, __global const TriangleLeaf* leaves,
                __global const PlacedMesh* instances, uint item, uint instance, uint lane, float3* lo, float3* hi,
                uint* child, uint* child_instance) {
  *child_instance = instance;
  if (instance == NO_INSTANCE && (item & BVH_LEAF)) {
    __global const TriangleLeaf* leaf = &leaves[item & ~BVH_LEAF];
    if (lane >= BVH_LEAF_PAIRS || leaf->triangle[lane] == BVH_EMPTY) return false;
    *lo = (float3)(leaf->p[0][lane], leaf->p[1][lane], leaf->p[2][lane]);
    const uint upper = BVH_LEAF_WIDTH + lane;
    *hi = (float3)(leaf->p[0][upper], leaf->p[1][upper], leaf->p[2][upper]);
    *child_instance = leaf->triangle[lane];
    *child = instances[leaf->triangle[lane]].root;
    return true;
  }
  __global const BvhNode* node = &nodes[item];
  if (lane >= BVH_CHILDREN(node)) return false;
  *child = BVH_ITEM(node, lane);
  if (instance == NO_INSTANCE) {
    *lo = (float3)(node->lo[0][lane], node->lo[1][lane], node->lo[2][lane]);
    *hi = (float3)(node->hi[0][lane], node->hi[1][lane], node->hi[2][lane]);
    return true;
  }
  __global const PlacedMesh* mesh = &instances[instance];
  *lo = (float3)(placed_plane(node, lane, mesh->point[0], false), placed_plane(node, lane, mesh->point[1], false),
                 placed_plane(node, lane, mesh->point[2], false));
  *hi = (float3)(placed_plane(node, lane, mesh->point[0], true), placed_plane(node, lane, mesh->point[1], true),
                 placed_plane(node, lane, mesh->point[2], true));
  return true;
}

float3 placed_vertex(__global const TriangleLeaf* leaf, uint corner, uint lane, __global const PlacedMesh* mesh) {
  const uint place = BVH_CORNER(corner, lane);
  return placed_point(mesh, (float3)(leaf->p[0][place], leaf->p[1][place], leaf->p[2][place]));
}

// TriangleLeaf.near_height of a placed triangle.
float placed_near_height(float3 p0, float3 p1, float3 p2) {
  const float3 size = fmax(p0, fmax(p1, p2)) - fmin(p0, fmin(p1, p2));
  const float extent = greater(greater(size.x, size.y), size.z);
  return NEAR_HEIGHT(extent);
}

// LANE_IN_HOLE() for a triangle whose corners are placed already.
#if CUT_OUTS
bool placed_in_hole(CUT_PARAMS, uint stored, float3 o, const RayShear* shear, float3 p0, float3 p1, float3 p2) {
  const ShearedTriangle t = shear_triangle(o, shear, p0, p1, p2);
  return IN_HOLE(stored, t.wb / t.det, t.wc / t.det);
}
#define PLACED_IN_HOLE(stored, o, shear, p0, p1, p2) placed_in_hole(CUT_ARGS, stored, o, shear, p0, p1, p2)
#else
#define PLACED_IN_HOLE(stored, o, shear, p0, p1, p2) false
#endif

bool occluded_ray(BVH_PARAMS, float3 o, float3 d, float max_distance) {
  const float3 inverse = 1.0f / d;
  const RayShear shear = shear_ray(d);
  const float limit_z = max_distance * fabs(component(d, shear.kz));
  uint stack[BVH_STACK_SIZE], stack_instance[BVH_STACK_SIZE];
  uint size = 1;
  stack[0] = 0;
  stack_instance[0] = NO_INSTANCE;
  while (size > 0) {
    const uint item = stack[--size], instance = stack_instance[size];
    if ((item & BVH_LEAF) && instance != NO_INSTANCE) {
      __global const TriangleLeaf* leaf = &leaves[item & ~BVH_LEAF];
      __global const PlacedMesh* mesh = &instances[instance];
      for (uint lane = 0; lane < BVH_LEAF_WIDTH; ++lane) {
        if (leaf->triangle[lane] == NO_TRIANGLE) continue;
        const float3 p0 = placed_vertex(leaf, 0, lane, mesh), p1 = placed_vertex(leaf, 1, lane, mesh),
                     p2 = placed_vertex(leaf, 2, lane, mesh);
        if (!triangle_occludes(o, d, &shear, max_distance, limit_z, p0, p1, p2, placed_near_height(p0, p1, p2))) continue;
        if (!PLACED_IN_HOLE(leaf->triangle[lane], o, &shear, p0, p1, p2)) return true;
      }
      continue;
    }
    for (uint lane = 0; lane < BVH_WIDTH; ++lane) {
      float3 lo, hi;
      uint child, child_instance;
      if (!open_child(nodes, leaves, instances, item, instance, lane, &lo, &hi, &child, &child_instance)) break;
      if (!(enter_box(lo, hi, o, inverse, max_distance) < INFINITY)) continue;
      stack[size] = child;
      stack_instance[size++] = child_instance;
    }
  }
  return false;
}

#define MOVE_PLACED_RAY(to, from) stack[to] = stack[from]; stack_instance[to] = stack_instance[from];

// The nearest of equally near triangles is the one of the lowest number in the scene.
bool closest_ray(BVH_PARAMS, float3 o, float3 d, float* t, uint* triangle, float* u, float* v) {
  const float3 inverse = 1.0f / d;
  const RayShear shear = shear_ray(d);
  uint stack[BVH_STACK_SIZE], stack_instance[BVH_STACK_SIZE];
  float entry[BVH_STACK_SIZE];
  uint size = 1;
  uint found = NO_TRIANGLE;
  stack[0] = 0;
  stack_instance[0] = NO_INSTANCE;
  entry[0] = 0.0f;
  while (size > 0) {
    const uint item = stack[--size], instance = stack_instance[size];
    if (entry[size] > *t * FAR_PLANE_GROWTH) continue;
    if ((item & BVH_LEAF) && instance != NO_INSTANCE) {
      __global const TriangleLeaf* leaf = &leaves[item & ~BVH_LEAF];
      __global const PlacedMesh* mesh = &instances[instance];
      for (uint lane = 0; lane < BVH_LEAF_WIDTH; ++lane) {
        if (leaf->triangle[lane] == NO_TRIANGLE) continue;
        const uint id = leaf->triangle[lane] - mesh->mesh_triangle + mesh->first_triangle;
        float distance = nextafter(*t, INFINITY);
        float hit_u, hit_v;
        const float3 p0 = placed_vertex(leaf, 0, lane, mesh), p1 = placed_vertex(leaf, 1, lane, mesh),
                     p2 = placed_vertex(leaf, 2, lane, mesh);
        if (!triangle_nearer(o, d, &shear, p0, p1, p2, placed_near_height(p0, p1, p2), &distance, &hit_u, &hit_v))
          continue;
        if (distance == *t && (found == NO_TRIANGLE || id > found)) continue;
        if (IN_HOLE(leaf->triangle[lane], hit_u, hit_v)) continue;
        found = id;
        *t = distance;
        *u = hit_u;
        *v = hit_v;
      }
      continue;
    }
    const uint first = size;
    for (uint lane = 0; lane < BVH_WIDTH; ++lane) {
      float3 lo, hi;
      uint child, child_instance;
      if (!open_child(nodes, leaves, instances, item, instance, lane, &lo, &hi, &child, &child_instance)) break;
      const float enter = enter_box(lo, hi, o, inverse, *t);
      if (!(enter < INFINITY)) continue;
      uint place = size++;
      INSERT_BY_ENTRY(place, first, entry, enter, MOVE_PLACED_RAY)
      stack[place] = child;
      stack_instance[place] = child_instance;
    }
  }
  *triangle = found;
  return found != NO_TRIANGLE;
}

#endif

#endif
