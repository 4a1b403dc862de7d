// The benchmark's rays (bench/support/rays.hpp) through the renderer's traversal.
#include "trace/traverse.cl"

#pragma OPENCL FP_CONTRACT OFF

#define DIRECTION_SETS 256u

uint set_of_point(uint i) {
  i = (i ^ (i >> 16)) * 0x7feb352du;
  i = (i ^ (i >> 15)) * 0x846ca68bu;
  return (i ^ (i >> 16)) & (DIRECTION_SETS - 1u);
}

float3 load3(__global const float* p) { return (float3)(p[0], p[1], p[2]); }

// Directions [first, first + count) of point i; returns the mask of those above its horizon.
uint make_directions(__global const float* point, uint i, __global const float* sets, uint size, uint first, uint count,
                     uint slot, RayDirections* out) {
  const float3 n = load3(point + 3), horizon = load3(point + 6);
  const float sign = copysign(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
  const float3 s = (float3)(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
  const float3 t = (float3)(b, sign + n.y * n.y * a, -n.y);
  __global const float* set = sets + 3u * (set_of_point(i) * size + first);
  uint active = 0;
  for (uint k = 0; k < count; ++k) {
    const float3 d = load3(set + 3 * k);
    const float3 w = d.x * s + d.y * t + d.z * n;
    out->x[slot + k] = w.x;
    out->y[slot + k] = w.y;
    out->z[slot + k] = w.z;
    if (w.x * horizon.x + w.y * horizon.y + w.z * horizon.z > 0.0f) active |= 1u << (slot + k);
  }
  return active;
}

// `size` directions (at most 32) from each point, as many points a stream as fit; bits[i]: those of point i occluded.
__kernel void occlusion_shared(BVH_PARAMS, __global const float* points, uint count, __global const float* sets, uint size,
                               float max_distance, __global uint* bits) {
  const uint per_stream = 32u / size;
  const uint begin = get_global_id(0) * per_stream;
  if (begin >= count) return;
  const uint n = min(per_stream, count - begin);
  RayDirections o, d;
  uint active = 0;
  for (uint j = 0; j < n; ++j) {
    __global const float* point = points + 9 * (begin + j);
    active |= make_directions(point, begin + j, sets, size, 0, size, j * size, &d);
    for (uint k = j * size; k < (j + 1) * size; ++k) o.x[k] = point[0], o.y[k] = point[1], o.z[k] = point[2];
  }
  const uint occluded = occluded_rays(BVH_ARGS, &o, &d, active, max_distance);
  for (uint j = 0; j < n; ++j) bits[begin + j] = occluded >> (j * size) & (0xffffffffu >> (32u - size));
}

// One direction (direction 0 of its set) from each point, 32 consecutive points a stream; bits[i / 32]: those occluded.
__kernel void occlusion_own(BVH_PARAMS, __global const float* points, uint count, __global const float* sets, uint size,
                            float max_distance, __global uint* bits) {
  const uint begin = get_global_id(0) * 32u;
  if (begin >= count) return;
  RayDirections o, d;
  uint active = 0;
  for (uint k = 0; k < min(32u, count - begin); ++k) {
    const uint i = begin + k;
    active |= make_directions(points + 9 * i, i, sets, size, 0, 1, k, &d);
    o.x[k] = points[9 * i], o.y[k] = points[9 * i + 1], o.z[k] = points[9 * i + 2];
  }
  bits[begin / 32u] = occluded_rays(BVH_ARGS, &o, &d, active, max_distance);
}

// `size` camera rays (at most 32) a stream from one eye; their distances, INFINITY for a miss.
__kernel void closest_shared(BVH_PARAMS, __global const float* directions, uint count, float eye_x, float eye_y, float eye_z,
                             uint size, __global float* distances) {
  const uint begin = get_global_id(0) * size;
  if (begin >= count) return;
  RayDirections d;
  float t[32], u[32], v[32];
  uint triangle[32];
  const uint rays = min(size, count - begin);
  for (uint k = 0; k < rays; ++k) {
    const float3 w = load3(directions + 3 * (begin + k));
    d.x[k] = w.x, d.y[k] = w.y, d.z[k] = w.z;
    t[k] = INFINITY;
  }
  closest_from(BVH_ARGS, (float3)(eye_x, eye_y, eye_z), &d, 0xffffffffu >> (32u - rays), t, triangle, u, v);
  for (uint k = 0; k < rays; ++k) distances[begin + k] = triangle[k] == NO_TRIANGLE ? INFINITY : t[k];
}
