// First stage: `primary` finds the surface points of the camera rays; `occlusion` (occlusion.cl) estimates an effect at them.
#include "config.h"
#include "shared/arguments.h"
#include "shared/camera.h"
#include "shared/surface_point.h"
#include "shared/task.h"
#include "sample/camera.cl"
#include "sample/sampler.cl"
#include "stage/surface_points.cl"
#include "trace/traverse.cl"

#define STREAM 32u

void store3(__global float* out, float3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

void write_surface_point(__global SurfacePoint* out, const SurfaceFrames* frames, uint k, const RayDirections* directions,
                         float distance, uint triangle, uint material) {
  store3(out->origin, ray_direction(&frames->origin, k));
  out->flags = SURFACE_HIT;
  store3(out->normal, ray_direction(&frames->normal, k));
  out->triangle = triangle;
  store3(out->view, -ray_direction(directions, k));
  out->distance = distance;
  store3(out->geometric_normal, ray_direction(&frames->geometric_normal, k));
  out->material = material;
}

// Camera samples [task.first_sample, + p.samples) of each task's pixel: one SurfacePoint each. A work-item does `tasks_per_item`
// neighbouring tasks, whose rays share streams; tasks_per_item * p.samples <= STREAM if it does more than one.
__kernel void primary(BVH_PARAMS PRIMARY_ARGUMENTS(IN_PARAM, OUT_PARAM, VALUE_PARAM)) {
  const uint first_task = get_global_id(0) * tasks_per_item;
  if (first_task >= task_count) return;
  const uint rays = min(tasks_per_item, task_count - first_task) * p.samples;
  const float3 eye = (float3)(camera.eye[0], camera.eye[1], camera.eye[2]);
  const Vector from = {eye.x, eye.y, eye.z};
  SurfaceHits hits;
  clear_hits(&hits);
  uint pixel[STREAM], sample[STREAM], place[STREAM];
  for (uint k = 0; k < STREAM; ++k) pixel[k] = sample[k] = 0;
  for (uint begin = 0; begin < rays; begin += STREAM) {
    const uint count = min(STREAM, rays - begin);
    for (uint k = 0, i = begin / p.samples, of_task = begin % p.samples; k < count; ++k) {
      const Task task = tasks[first_task + i];
      pixel[k] = task.pixel;
      sample[k] = task.first_sample + of_task;
      place[k] = task.point + of_task;
      if (++of_task == p.samples) of_task = 0, ++i;
    }
    RayDirections directions;
    camera_directions(&camera, pixel, sample, count, &p, &directions);
    float t[STREAM], u[STREAM], v[STREAM];
    uint triangle[STREAM];
    for (uint k = 0; k < STREAM; ++k) t[k] = INFINITY;
    const uint active = count == STREAM ? 0xffffffffu : (1u << count) - 1u;
    closest_from(BVH_ARGS, eye, &directions, active, t, triangle, u, v);
    for (uint k = 0; k < count; ++k)
      if (triangle[k] != NO_TRIANGLE)
        gather_hit(&hits, k, TRIANGLE_ARGS, normals, triangle_normals, triangle[k], u[k], v[k]);
    SurfaceFrames frames;
    make_surface_frames(&hits, from, &directions, t, count, &frames);
    for (uint k = 0; k < count; ++k) {
      __global SurfacePoint* point = points + place[k];
      if (triangle[k] == NO_TRIANGLE) {
        point->flags = 0;
        continue;
      }
      write_surface_point(point, &frames, k, &directions, t[k], triangle[k],
                          MATERIALS ? triangle_materials[STORED(triangle[k])] : 0xffffffffu);
    }
  }
}
