// What a triangle's number stands for: where the mesh buffers have it, and where its corners lie. With INSTANCES the buffers hold
// each mesh once, in its own coordinates, and a number belongs to a placed mesh.
#ifndef NOOK_TRIANGLE_CL
#define NOOK_TRIANGLE_CL

#include "trace/placed_tree.cl"

// What a kernel passes through.
#define TRIANGLE_PARAMS __global const float *positions, __global const uint *triangles AND_INSTANCE_PARAMS
#define TRIANGLE_ARGS positions, triangles AND_INSTANCE_ARGS

float3 load3(__global const float* values, uint index) {
  return (float3)(values[3 * index], values[3 * index + 1], values[3 * index + 2]);
}

#if INSTANCES
// The placed mesh that has the triangle: the last that starts no later.
__global const PlacedMesh* mesh_of(__global const PlacedMesh* instances, uint triangle) {
  uint first = 0, end = instances->meshes;
  while (end - first > 1u) {
    const uint middle = first + (end - first) / 2u;
    if (instances[middle].first_triangle <= triangle)
      first = middle;
    else
      end = middle;
  }
  return instances + first;
}

uint stored_triangle(__global const PlacedMesh* instances, uint triangle) {
  __global const PlacedMesh* mesh = mesh_of(instances, triangle);
  return triangle - mesh->first_triangle + mesh->mesh_triangle;
}

float3 placed_normal(__global const PlacedMesh* mesh, float3 n) {
  const PlacedNormal placed = PLACED_NORMAL(mesh->normal, n.x, n.y, n.z);
  return (float3)(placed.x, placed.y, placed.z);
}

// Where the mesh buffers have the triangle, and one of its points or normals as they have it in the world.
#define STORED(triangle) stored_triangle(instances, triangle)
#define POINT_OF(triangle, p) placed_point(mesh_of(instances, triangle), p)
#define NORMAL_OF(triangle, n) placed_normal(mesh_of(instances, triangle), n)
#else
#define STORED(triangle) (triangle)
#define POINT_OF(triangle, p) (p)
#define NORMAL_OF(triangle, n) (n)
#endif

// A corner of the triangle, in the world.
float3 vertex(TRIANGLE_PARAMS, uint triangle, uint corner) {
  return POINT_OF(triangle, load3(positions, triangles[3 * STORED(triangle) + corner]));
}

#endif
