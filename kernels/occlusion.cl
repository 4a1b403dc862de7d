// Second stage: `occlusion` estimates an effect at surface points, found by `primary` (primary.cl) or given by the host (probe, bake).
#include "config.h"
#include "shared/surface_point.h"
#include "shared/task.h"
#include "shared/task_result.h"
#include "sampler.cl"
#include "traverse.cl"
#include "ambient.cl"
#include "reflection.cl"

#define STREAM 32u

// One direction at a surface point; returns its weight w with E[w V] the effect's value, 0 if it needs no ray.
float sample_effect(float2 u, __global const SurfacePoint* point, float exponent, float3* direction) {
  float3 normal = (float3)(point->normal[0], point->normal[1], point->normal[2]);
  if (EFFECT == EFFECT_REFLECTION) {
    float3 view = (float3)(point->view[0], point->view[1], point->view[2]);
    return reflection_sample(u, normal, view, exponent, direction);
  }
  return ambient_sample(u, normal, direction);
}

// The Phong exponent of the point's material; negative where it has no lobe, or no material.
float exponent_of(__global const SurfacePoint* point, __global const float* exponents) {
  return point->material == 0xffffffffu ? -1.0f : exponents[point->material];
}

// Directions [task.first_direction, + p.directions) at each camera sample of each task, summed into results[task].
__kernel void occlusion(BVH_PARAMS, EstimatorParams p, __global const Task* tasks, uint task_count,
                        __global const SurfacePoint* points, __global TaskResult* results,
                        __global const float* exponents) {
  uint id = get_global_id(0);
  if (id >= task_count) return;
  Task task = tasks[id];
  TaskResult result = {0, 0, 0, 0, 0, 0};
  for (uint s = 0; s < p.samples; ++s) {
    __global const SurfacePoint* point = points + task.point + s;
    if (!(point->flags & SURFACE_HIT)) continue;
    ++result.hits;
    float exponent = EXPONENT_OF_MATERIAL ? exponent_of(point, exponents) : p.exponent;
    if (EXPONENT_OF_MATERIAL && !(exponent >= 0.0f)) continue;
    float3 origin = (float3)(point->origin[0], point->origin[1], point->origin[2]);
    ulong of_sample = 0;
    for (uint begin = 0; begin < p.directions; begin += STREAM) {
      uint count = min(STREAM, p.directions - begin);
      RayDirections directions;
      float weight[STREAM];
      uint active = 0;
      for (uint k = 0; k < count; ++k) {
        float3 d;
        float2 square = sample_direction(task.pixel, task.first_sample + s, task.first_direction + begin + k, &p);
        float w = sample_effect(square, point, exponent, &d);
        if (!isfinite(w)) {
          ++result.rejected;
          w = 0.0f;
        }
        weight[k] = w;
        directions.x[k] = d.x;
        directions.y[k] = d.y;
        directions.z[k] = d.z;
        if (w > 0.0f) active |= 1u << k;
      }
      result.rays += popcount(active);
      uint open = active & ~occluded_from(BVH_ARGS, origin, &directions, active, p.max_distance);
      for (uint k = 0; k < count; ++k) {
        if (!(open >> k & 1u)) continue;
        of_sample += convert_ulong_rte(weight[k] * p.sum_scale);
        if (REPLICATE_DIRECTIONS) result.sum_square += convert_ulong_rte(weight[k] * weight[k] * p.square_scale);
      }
    }
    result.sum += of_sample;
    if (!REPLICATE_DIRECTIONS) {
      float mean = (float)of_sample / (p.sum_scale * (float)p.directions);
      result.sum_square += convert_ulong_rte(mean * mean * p.square_scale);
    }
  }
  results[id] = result;
}
