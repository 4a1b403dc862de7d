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

// Directions [task.first_direction, + p.directions) at each camera sample of each task, summed into results[task]. A stream
// holds the directions of as many camera samples as fit (32 / directions), or a part of one sample's.
__kernel void occlusion(BVH_PARAMS, EstimatorParams p, __global const Task* tasks, uint task_count,
                        __global const SurfacePoint* points, __global TaskResult* results,
                        __global const float* exponents) {
  uint id = get_global_id(0);
  if (id >= task_count) return;
  Task task = tasks[id];
  TaskResult result = {0, 0, 0, 0, 0, 0};
  const uint per_stream = max(1u, STREAM / p.directions);
  for (uint first = 0; first < p.samples; first += per_stream) {
    const uint samples = min(per_stream, p.samples - first);
    uint hits = 0;  // bit j: sample first + j has a surface to estimate at
    for (uint j = 0; j < samples; ++j) {
      __global const SurfacePoint* point = points + task.point + first + j;
      if (!(point->flags & SURFACE_HIT)) continue;
      ++result.hits;
      if (EXPONENT_OF_MATERIAL && !(exponent_of(point, exponents) >= 0.0f)) continue;
      hits |= 1u << j;
    }
    ulong of_sample[STREAM];
    for (uint j = 0; j < samples; ++j) of_sample[j] = 0;
    for (uint begin = 0; begin < p.directions; begin += STREAM) {
      const uint count = min(STREAM, p.directions - begin);
      RayDirections origins, directions;
      float weight[STREAM];
      uint active = 0;
      for (uint rest = hits; rest; rest &= rest - 1) {
        const uint j = lowest_bit(rest);
        __global const SurfacePoint* point = points + task.point + first + j;
        const float3 origin = (float3)(point->origin[0], point->origin[1], point->origin[2]);
        const float exponent = EXPONENT_OF_MATERIAL ? exponent_of(point, exponents) : p.exponent;
        for (uint k = 0; k < count; ++k) {
          const uint ray = j * count + k;
          float3 d;
          const float2 square =
              sample_direction(task.pixel, task.first_sample + first + j, task.first_direction + begin + k, &p);
          float w = sample_effect(square, point, exponent, &d);
          // A NaN normal or origin would pass for an open direction: no comparison with a NaN holds.
          if (!isfinite(w) || !isfinite(d.x + d.y + d.z) || !isfinite(origin.x + origin.y + origin.z)) {
            ++result.rejected;
            w = 0.0f;
          }
          weight[ray] = w;
          origins.x[ray] = origin.x, origins.y[ray] = origin.y, origins.z[ray] = origin.z;
          directions.x[ray] = d.x, directions.y[ray] = d.y, directions.z[ray] = d.z;
          if (w > 0.0f) active |= 1u << ray;
        }
      }
      result.rays += popcount(active);
      uint open = active & ~occluded_rays(BVH_ARGS, &origins, &directions, active, p.max_distance);
      for (; open; open &= open - 1) {
        const uint ray = lowest_bit(open);
        of_sample[ray / count] += convert_ulong_rte(weight[ray] * p.sum_scale);
        if (REPLICATE_DIRECTIONS) result.sum_square += convert_ulong_rte(weight[ray] * weight[ray] * p.square_scale);
      }
    }
    for (uint rest = hits; rest; rest &= rest - 1) {
      const uint j = lowest_bit(rest);
      result.sum += of_sample[j];
      if (REPLICATE_DIRECTIONS) continue;
      const float mean = (float)of_sample[j] / (p.sum_scale * (float)p.directions);
      result.sum_square += convert_ulong_rte(mean * mean * p.square_scale);
    }
  }
  results[id] = result;
}
