// Second stage: `occlusion` estimates an effect at surface points, found by `primary` (primary.cl) or given by the host (probe, bake).
#include "config.h"
#include "shared/surface_point.h"
#include "shared/task.h"
#include "shared/task_result.h"
#include "sampler.cl"
#include "visibility.cl"
#include "ambient.cl"
#include "reflection.cl"
#include "cone.cl"
#include "reach.cl"
#include "sets.cl"
#include "side.cl"
#include "shared/camera.h"

#define STREAM 32u
#define TASKS_PER_ITEM (TRAVERSAL_SCALAR ? 1 : 32)  // at most

// One direction at a surface point; returns its weight w with E[w V] the effect's value, 0 if it needs no ray.
float sample_effect(float2 u, float3 normal, float3 view, float exponent, const EstimatorParams* p, float3* direction) {
  if (EFFECT == EFFECT_REFLECTION) return reflection_sample(u, normal, view, exponent, direction);
  if (CONE) return ambient_cone_sample(u, normal, p->cone_sine, p->cone_cosine, direction);
  return ambient_sample(u, normal, direction);
}

// The Phong exponent of the point's material; negative where it has no lobe, or no material.
float exponent_of(__global const SurfacePoint* point, __global const float* exponents) {
  return point->material == 0xffffffffu ? -1.0f : exponents[point->material];
}

// Bent normals: Σ w V ω in fixed point (two's complement), in world space or along the camera's right, up and back axes.
void add_direction(ulong* sum, float weight, float3 d, const CameraParams* camera) {
  if (BENT_VIEW) {
    const float3 right = (float3)(camera->right[0], camera->right[1], camera->right[2]);
    const float3 up = (float3)(camera->up[0], camera->up[1], camera->up[2]);
    const float3 forward = (float3)(camera->forward[0], camera->forward[1], camera->forward[2]);
    d = (float3)(dot(d, right), dot(d, up), -dot(d, forward));
  }
  sum[0] += as_ulong(convert_long_rte(weight * d.x));
  sum[1] += as_ulong(convert_long_rte(weight * d.y));
  sum[2] += as_ulong(convert_long_rte(weight * d.z));
}

// Directions [task.first_direction, + p.directions) at each camera sample of each task, summed into results[task]. A stream
// holds the directions of as many camera samples as fit (32 / directions), or a part of one sample's. A work-item does
// `tasks_per_item` neighbouring tasks, whose samples share streams: tasks_per_item * p.samples * p.directions <= STREAM if it does
// more than one.
__kernel void occlusion(BVH_PARAMS, EstimatorParams p, __global const Task* tasks, uint task_count, uint tasks_per_item,
                        __global const SurfacePoint* points, __global TaskResult* results,
                        __global const float* exponents, __global const float* positions,
                        __global const uint* triangles, CameraParams camera, __global nook_ulong* bent,
                        __global const uint* receivers, __global const uint* triangle_groups,
                        __global const uint* first_of_group) {
  const uint first_task = get_global_id(0) * tasks_per_item;
  if (first_task >= task_count) return;
  const uint count_of_tasks = min(tasks_per_item, task_count - first_task);
  TaskResult result[TASKS_PER_ITEM];
  ulong bent_sum[TASKS_PER_ITEM][3];
  for (uint i = 0; i < count_of_tasks; ++i) {
    const TaskResult nothing = {0, 0, 0, 0, 0, 0};
    result[i] = nothing;
    bent_sum[i][0] = bent_sum[i][1] = bent_sum[i][2] = 0;
  }
  // Camera samples are numbered through all tasks of the work-item.
  const uint all_samples = count_of_tasks * p.samples;
  const uint per_stream = max(1u, STREAM / p.directions);
  for (uint first = 0; first < all_samples; first += per_stream) {
    const uint samples = min(per_stream, all_samples - first);
    uint hits = 0;  // bit j: sample first + j has a surface to estimate at
    for (uint j = 0; j < samples; ++j) {
      const uint task = (first + j) / p.samples;
      __global const SurfacePoint* point = points + tasks[first_task + task].point + (first + j) % p.samples;
      if (!(point->flags & SURFACE_HIT)) continue;
      ++result[task].hits;
      if (RECEIVERS && point->triangle != NO_TRIANGLE && !receives(receivers, STORED(point->triangle))) continue;
      if (ONLY_SELF && point->triangle == NO_TRIANGLE) continue;
      if (EXPONENT_OF_MATERIAL && !(exponent_of(point, exponents) >= 0.0f)) continue;
      hits |= 1u << j;
    }
    ulong of_sample[STREAM];
    for (uint j = 0; j < samples; ++j) of_sample[j] = 0;
    uint free = hits;  // bit j: sample first + j has had nothing in reach
    for (uint begin = 0; begin < p.directions; begin += STREAM) {
      const uint count = min(STREAM, p.directions - begin);
      RayDirections origins, directions;
      float weight[STREAM];
      uint group[STREAM];
      uint active = 0;
      AskedPoints asked;
      for (uint rest = hits; rest; rest &= rest - 1) {
        const uint j = lowest_bit(rest);
        const uint of_item = (first + j) / p.samples, sample = (first + j) % p.samples;
        const Task task = tasks[first_task + of_item];
        __global const SurfacePoint* point = points + task.point + sample;
        const float exponent = EXPONENT_OF_MATERIAL ? exponent_of(point, exponents) : p.exponent;
        float3 origin = (float3)(point->origin[0], point->origin[1], point->origin[2]);
        float3 normal = (float3)(point->normal[0], point->normal[1], point->normal[2]);
        const float3 view = (float3)(point->view[0], point->view[1], point->view[2]);
        if (SIDE != SIDE_NORMAL && looks_to_the_other_side(normal, view)) {
          origin = origin_on_other_side(point, TRIANGLE_ARGS, origin, normal);
          normal = -normal;
        }
        if (REACH) asked.nx[j] = normal.x, asked.ny[j] = normal.y, asked.nz[j] = normal.z;
        if (REACH && ONLY_SELF) asked.set[j] = triangle_groups[point->triangle];
        for (uint k = 0; k < count; ++k) {
          const uint ray = j * count + k;
          float3 d;
          const float2 square =
              sample_direction(task.pixel, task.first_sample + sample, task.first_direction + begin + k, &p);
          float w = sample_effect(square, normal, view, exponent, &p, &d);
          // A NaN normal or origin would pass for an open direction: no comparison with a NaN holds.
          if (!isfinite(w) || !isfinite(d.x + d.y + d.z) || !isfinite(origin.x + origin.y + origin.z)) {
            ++result[of_item].rejected;
            w = 0.0f;
          }
          weight[ray] = w;
          if (ONLY_SELF) group[ray] = triangle_groups[point->triangle];
          origins.x[ray] = origin.x, origins.y[ray] = origin.y, origins.z[ray] = origin.z;
          directions.x[ray] = d.x, directions.y[ray] = d.y, directions.z[ray] = d.z;
          if (w > 0.0f) {
            active |= 1u << ray;
            ++result[of_item].rays;
          }
        }
      }
      float visibility[STREAM];
      uint unreached = 0;
      if (REACH) {
        uint rest = hits;
        while (rest) {
          const uint j = lowest_bit(rest), of_item = (first + j) / p.samples;
          const uint end = p.directions >= ASKED_ALONE ? j + 1u : min(samples, (of_item + 1u) * p.samples - first);
          const uint together = rest & (end == 32u ? 0xffffffffu : (1u << end) - 1u);
          rest &= ~together;
          // What was in reach of the first directions is in reach.
          const uint out = together & ~free ? 0u
                                            : unreached_rays(nodes, leaves AND_INSTANCE_ARGS, first_of_group, &asked, together, count, &origins,
                                                             &directions, active, &p);
          if (!out) free &= ~together;
          result[of_item].rays -= popcount(out);
          unreached |= out;
        }
      }
      active &= ~unreached;
      uint open = ONLY_SELF ? visible_within_groups(BVH_ARGS, first_of_group, group, &origins, &directions, active, &p,
                                                    visibility)
                            : visible_rays(BVH_ARGS, &origins, &directions, active, &p, visibility);
      if (FALLOFF != FALLOFF_NONE)
        for (uint rest = unreached; rest; rest &= rest - 1) visibility[lowest_bit(rest)] = 1.0f;
      for (open |= unreached; open; open &= open - 1) {
        const uint ray = lowest_bit(open), j = ray / count, of_item = (first + j) / p.samples;
        const float value = FALLOFF == FALLOFF_NONE ? weight[ray] : weight[ray] * visibility[ray];
        of_sample[j] += convert_ulong_rte(value * p.sum_scale);
        if (REPLICATE_DIRECTIONS) result[of_item].sum_square += convert_ulong_rte(value * value * p.square_scale);
        if (BENT) add_direction(bent_sum[of_item], value * p.sum_scale, ray_direction(&directions, ray), &camera);
      }
    }
    for (uint rest = hits; rest; rest &= rest - 1) {
      const uint j = lowest_bit(rest), of_item = (first + j) / p.samples;
      result[of_item].sum += of_sample[j];
      if (REACH) result[of_item].free += free >> j & 1u;
      if (REPLICATE_DIRECTIONS) continue;
      const float mean = (float)of_sample[j] / (p.sum_scale * (float)p.directions);
      result[of_item].sum_square += convert_ulong_rte(mean * mean * p.square_scale);
    }
  }
  for (uint i = 0; i < count_of_tasks; ++i) {
    results[first_task + i] = result[i];
    if (BENT)
      for (uint axis = 0; axis < 3; ++axis) bent[3 * (first_task + i) + axis] = bent_sum[i][axis];
  }
}
