// One ray at a time, a child at a time: the traversal for GPUs, and the plain form that the others are tested against.
#ifndef NOOK_TRAVERSE_SCALAR_CL
#define NOOK_TRAVERSE_SCALAR_CL

#include "trace/insertion.cl"
#include "trace/intersect.cl"
#include "trace/leaf_holes.cl"

#if !INSTANCES

float enter_child(__global const BvhNode* node, uint lane, float3 o, float3 inverse, float limit) {
  const float3 lo = (float3)(node->lo[0][lane], node->lo[1][lane], node->lo[2][lane]);
  const float3 hi = (float3)(node->hi[0][lane], node->hi[1][lane], node->hi[2][lane]);
  return enter_box(lo, hi, o, inverse, limit);
}

bool occluded_ray(BVH_PARAMS, float3 o, float3 d, float max_distance) {
  const float3 inverse = 1.0f / d;
  const RayShear shear = shear_ray(d);
  const float limit_z = max_distance * fabs(component(d, shear.kz));
  uint stack[BVH_STACK_SIZE];
  uint size = 1;
  stack[0] = 0;
  while (size > 0) {
    const uint item = stack[--size];
    if (item & BVH_LEAF) {
      __global const TriangleLeaf* leaf = &leaves[item & ~BVH_LEAF];
      for (uint lane = 0; lane < BVH_LEAF_WIDTH; ++lane) {
        if (leaf->triangle[lane] == NO_TRIANGLE) continue;
        if (triangle_occludes(o, d, &shear, max_distance, limit_z, leaf_vertex(leaf, 0, lane), leaf_vertex(leaf, 1, lane),
                              leaf_vertex(leaf, 2, lane), leaf->near_height[lane]) &&
            !LANE_IN_HOLE(leaf, lane, o, d))
          return true;
      }
    } else {
      __global const BvhNode* node = &nodes[item];
      for (uint lane = 0; lane < BVH_CHILDREN(node); ++lane)
        if (enter_child(node, lane, o, inverse, max_distance) < INFINITY) stack[size++] = BVH_ITEM(node, lane);
    }
  }
  return false;
}

#define MOVE_RAY(to, from) stack[to] = stack[from];

// The nearest of equally near triangles is the one of the lowest index, whatever the order of the visit.
bool closest_ray(BVH_PARAMS, float3 o, float3 d, float* t, uint* triangle, float* u, float* v) {
  const float3 inverse = 1.0f / d;
  const RayShear shear = shear_ray(d);
  uint stack[BVH_STACK_SIZE];
  float entry[BVH_STACK_SIZE];
  uint size = 1;
  uint found = NO_TRIANGLE;
  stack[0] = 0;
  entry[0] = 0.0f;
  while (size > 0) {
    const uint item = stack[--size];
    if (entry[size] > *t * FAR_PLANE_GROWTH) continue;
    if (item & BVH_LEAF) {
      __global const TriangleLeaf* leaf = &leaves[item & ~BVH_LEAF];
      for (uint lane = 0; lane < BVH_LEAF_WIDTH; ++lane) {
        if (leaf->triangle[lane] == NO_TRIANGLE) continue;
        float distance = nextafter(*t, INFINITY);
        float hit_u, hit_v;
        if (!triangle_nearer(o, d, &shear, leaf_vertex(leaf, 0, lane), leaf_vertex(leaf, 1, lane), leaf_vertex(leaf, 2, lane),
                             leaf->near_height[lane], &distance, &hit_u, &hit_v))
          continue;
        if (distance == *t && (found == NO_TRIANGLE || leaf->triangle[lane] > found)) continue;
        if (IN_HOLE(leaf->triangle[lane], hit_u, hit_v)) continue;
        found = leaf->triangle[lane];
        *t = distance;
        *u = hit_u;
        *v = hit_v;
      }
    } else {
      __global const BvhNode* node = &nodes[item];
      const uint first = size;
      for (uint lane = 0; lane < BVH_CHILDREN(node); ++lane) {
        const float enter = enter_child(node, lane, o, inverse, *t);
        if (!(enter < INFINITY)) continue;
        uint place = size++;
        INSERT_BY_ENTRY(place, first, entry, enter, MOVE_RAY)
        stack[place] = BVH_ITEM(node, lane);
      }
    }
  }
  *triangle = found;
  return found != NO_TRIANGLE;
}

#endif

#endif
