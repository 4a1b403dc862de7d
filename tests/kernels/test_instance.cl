// Placed vertices and normals as the kernels compute them.
#include "trace/triangle.cl"

#if INSTANCES
__kernel void place(__global const PlacedMesh* instances, __global const float* points, __global const float* normals,
                    __global float* placed_points, __global float* placed_normals) {
  const uint i = get_global_id(0);
  __global const PlacedMesh* mesh = instances + i % instances->meshes;
  const float3 p = placed_point(mesh, load3(points, i)), n = placed_normal(mesh, load3(normals, i));
  placed_points[3 * i] = p.x, placed_points[3 * i + 1] = p.y, placed_points[3 * i + 2] = p.z;
  placed_normals[3 * i] = n.x, placed_normals[3 * i + 1] = n.y, placed_normals[3 * i + 2] = n.z;
}
#endif
