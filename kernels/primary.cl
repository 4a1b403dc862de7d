// First stage: `primary` finds the surface points of the camera rays; `occlusion` (occlusion.cl) estimates an effect at them.
#include "config.h"
#include "shared/surface_point.h"
#include "shared/task.h"
#include "camera.cl"
#include "sampler.cl"
#include "traverse.cl"
#include "triangle.cl"

#define STREAM 32u

void store3(__global float* out, float3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

// Shading normal: the vertex normals interpolated, or the geometric normal where a corner has none or they cancel.
// Never flipped towards the viewer (TinyRender).
float3 shading_normal(WITH_INSTANCE_PARAMS __global const float* normals, __global const uint* triangle_normals, uint triangle,
                      float u, float v, float3 geometric) {
  if (!VERTEX_NORMALS) return geometric;
  const uint corner = 3 * STORED(triangle);
  uint i0 = triangle_normals[corner], i1 = triangle_normals[corner + 1], i2 = triangle_normals[corner + 2];
  const uint none = 0xffffffffu;
  if (i0 == none || i1 == none || i2 == none) return geometric;
  float3 n = (1.0f - u - v) * NORMAL_OF(triangle, load3(normals, i0)) + u * NORMAL_OF(triangle, load3(normals, i1)) +
             v * NORMAL_OF(triangle, load3(normals, i2));
  float length2 = dot(n, n);
  return length2 > 1e-12f ? n * rsqrt(length2) : geometric;
}

// The unit normal of triangle (p0, p1, p2). The edges are scaled first: a triangle of size 1e-15 would underflow.
float3 triangle_normal(float3 p0, float3 p1, float3 p2) {
  float3 a = p1 - p0, b = p2 - p0;
  float3 extent = fmax(fabs(a), fabs(b));
  float scale = fmax(extent.x, fmax(extent.y, extent.z));
  float3 n = cross(a / scale, b / scale);
  return n / sqrt(dot(n, n));
}

void write_surface_point(__global SurfacePoint* out, TRIANGLE_PARAMS, __global const float* normals,
                         __global const uint* triangle_normals, __global const uint* triangle_materials, float3 direction,
                         float distance, uint triangle, float u, float v) {
  if (triangle == 0xffffffffu) {
    out->flags = 0;
    return;
  }
  float3 p0 = vertex(TRIANGLE_ARGS, triangle, 0), p1 = vertex(TRIANGLE_ARGS, triangle, 1),
         p2 = vertex(TRIANGLE_ARGS, triangle, 2);
  float3 geometric = triangle_normal(p0, p1, p2);
  float3 normal = shading_normal(WITH_INSTANCE_ARGS normals, triangle_normals, triangle, u, v, geometric);
  float side = dot(geometric, normal) < 0.0f ? -1.0f : 1.0f;
  store3(out->origin, offset_origin(p0, p1, p2, u, v, geometric, side));
  out->flags = SURFACE_HIT;
  store3(out->normal, normal);
  out->triangle = triangle;
  store3(out->view, -direction);
  out->distance = distance;
  store3(out->geometric_normal, geometric);
  out->material = MATERIALS ? triangle_materials[STORED(triangle)] : 0xffffffffu;
}

// Camera samples [task.first_sample, + p.samples) of each task's pixel: one SurfacePoint each. A work-item does `tasks_per_item`
// neighbouring tasks, whose rays share streams; tasks_per_item * p.samples <= STREAM if it does more than one.
__kernel void primary(BVH_PARAMS, __global const float* positions, __global const uint* triangles,
                      __global const float* normals, __global const uint* triangle_normals,
                      __global const uint* triangle_materials, CameraParams camera, EstimatorParams p,
                      __global const Task* tasks, uint task_count, uint tasks_per_item, __global SurfacePoint* points) {
  const uint first_task = get_global_id(0) * tasks_per_item;
  if (first_task >= task_count) return;
  const uint rays = min(tasks_per_item, task_count - first_task) * p.samples;
  const float3 eye = (float3)(camera.eye[0], camera.eye[1], camera.eye[2]);
  for (uint begin = 0; begin < rays; begin += STREAM) {
    const uint count = min(STREAM, rays - begin);
    RayDirections directions;
    float t[STREAM], u[STREAM], v[STREAM];
    uint triangle[STREAM];
    for (uint k = 0; k < count; ++k) {
      const Task task = tasks[first_task + (begin + k) / p.samples];
      const float2 position = sample_pixel(task.pixel, task.first_sample + (begin + k) % p.samples, &p);
      const float3 d = camera_direction(&camera, task.pixel % camera.width, task.pixel / camera.width, position);
      directions.x[k] = d.x;
      directions.y[k] = d.y;
      directions.z[k] = d.z;
      t[k] = INFINITY;
    }
    const uint active = count == STREAM ? 0xffffffffu : (1u << count) - 1u;
    closest_from(BVH_ARGS, eye, &directions, active, t, triangle, u, v);
    for (uint k = 0; k < count; ++k) {
      const uint point = tasks[first_task + (begin + k) / p.samples].point + (begin + k) % p.samples;
      write_surface_point(points + point, TRIANGLE_ARGS, normals, triangle_normals, triangle_materials,
                          ray_direction(&directions, k), t[k], triangle[k], u[k], v[k]);
    }
  }
}
