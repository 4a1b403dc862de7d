// Second stage: `occlusion` estimates an effect at surface points, found by `primary` (primary.cl) or given by the host (probe, bake).
#include "config.h"
#include "shared/arguments.h"
#include "shared/surface_point.h"
#include "shared/task.h"
#include "shared/task_result.h"
#include "stage/directions.cl"
#include "stage/fixed_point.cl"
#include "effect/visibility.cl"
#include "effect/reach.cl"
#include "effect/sets.cl"
#include "effect/side.cl"
#include "trace/prefetch.cl"
#include "shared/camera.h"

#define STREAM 32u
// Open rays need only be counted.
#define WEIGHTS_ARE_1 (EFFECT == EFFECT_AMBIENT && SAMPLING == SAMPLING_COSINE && FALLOFF == FALLOFF_NONE)
#define TASKS_PER_ITEM (TRAVERSAL_SCALAR ? 1 : 32)  // at most

// The Phong exponent of the point's material; negative where it has no lobe, or no material.
float exponent_of(__global const SurfacePoint* point, __global const float* exponents) {
  return point->material == 0xffffffffu ? -1.0f : exponents[point->material];
}

// Whether the effect is estimated at the point: it is on a surface that is to receive it.
bool takes_part(WITH_INSTANCE_PARAMS __global const SurfacePoint* point, __global const float* exponents,
                __global const uint* receivers) {
  if (!(point->flags & SURFACE_HIT)) return false;
  if (RECEIVERS && point->triangle != NO_TRIANGLE && !receives(receivers, STORED(point->triangle))) return false;
  if (ONLY_SELF && point->triangle == NO_TRIANGLE) return false;
  return !EXPONENT_OF_MATERIAL || exponent_of(point, exponents) >= 0.0f;
}

// Bent normals: Σ w V ω in fixed point (two's complement), in world space or along the camera's right, up and back axes.
void add_direction(ulong* sum, float weight, float3 d, const CameraParams* camera) {
  if (BENT_VIEW) {
    const float3 right = (float3)(camera->right[0], camera->right[1], camera->right[2]);
    const float3 up = (float3)(camera->up[0], camera->up[1], camera->up[2]);
    const float3 forward = (float3)(camera->forward[0], camera->forward[1], camera->forward[2]);
    d = (float3)(dot(d, right), dot(d, up), -dot(d, forward));
  }
  sum[0] += to_fixed_point(weight * d.x);
  sum[1] += to_fixed_point(weight * d.y);
  sum[2] += to_fixed_point(weight * d.z);
}

// Directions [task.first_direction, + p.directions) at each camera sample of each task, summed into results[task]. A stream
// holds the directions of as many camera samples as fit (32 / directions), or a part of one sample's. A work-item does
// `tasks_per_item` neighbouring tasks, whose samples share streams: tasks_per_item * p.samples * p.directions <= STREAM if it does
// more than one.
__kernel void occlusion(BVH_PARAMS OCCLUSION_ARGUMENTS(IN_PARAM, OUT_PARAM, VALUE_PARAM)) {
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
  const uint per_stream = max(1u, STREAM / p.directions);
  const ulong one = to_fixed_point(p.sum_scale), square_of_one = to_fixed_point(p.square_scale);
  RayKeys keys;
  clear_keys(&keys);
  for (uint task = 0, sample = 0; task < count_of_tasks;) {
    // The next camera samples that have a surface to estimate at, numbered from 0.
    uint found = 0, item[STREAM], number[STREAM];
    while (task < count_of_tasks && found < per_stream) {
      __global const SurfacePoint* point = points + tasks[first_task + task].point + sample;
      item[found] = task;
      number[found] = sample;
      result[task].hits += (point->flags & SURFACE_HIT) != 0;
      found += takes_part(WITH_INSTANCE_ARGS point, exponents, receivers);
      if (++sample == p.samples) sample = 0, ++task;
    }
    // Those that come next are on their way while these are traced.
    for (uint i = task, s = sample, n = 0; i < count_of_tasks && n < per_stream; ++n) {
      PREFETCH_LINE(points + tasks[first_task + i].point + s, 0u);
      if (++s == p.samples) s = 0, ++i;
    }
    ulong of_sample[STREAM];
    for (uint j = 0; j < found; ++j) of_sample[j] = 0;
    uint free = found == STREAM ? 0xffffffffu : (1u << found) - 1u;  // samples that have had nothing in reach
    for (uint begin = 0; found && begin < p.directions; begin += STREAM) {
      const uint count = min(STREAM, p.directions - begin), rays = found * count;
      const uint of_one = count == STREAM ? 0xffffffffu : (1u << count) - 1u;
      RayDirections origins, directions;
      uint group[STREAM];
      uint sound = 0;  // rays from points that are finite
      AskedPoints asked;
      for (uint j = 0; j < found; ++j) {
        const Task of = tasks[first_task + item[j]];
        __global const SurfacePoint* point = points + of.point + number[j];
        const float exponent = EXPONENT_OF_MATERIAL ? exponent_of(point, exponents) : p.exponent;
        float3 origin = (float3)(point->origin[0], point->origin[1], point->origin[2]);
        float3 normal = (float3)(point->normal[0], point->normal[1], point->normal[2]);
        const float3 view = (float3)(point->view[0], point->view[1], point->view[2]);
        if (SIDE != SIDE_NORMAL && looks_to_the_other_side(point, normal, view)) {
          origin = origin_on_other_side(point, TRIANGLE_ARGS, origin, normal);
          normal = -normal;
        }
        if (REACH) asked.nx[j] = normal.x, asked.ny[j] = normal.y, asked.nz[j] = normal.z;
        if (REACH && ONLY_SELF) asked.set[j] = triangle_groups[point->triangle];
        if (isfinite(origin.x + origin.y + origin.z)) sound |= of_one << j * count;
        const uint seed = REPLICATE_DIRECTIONS ? seed_of_randomisation(p.seed, of.first_sample) : p.seed;
        const uint camera_sample = REPLICATE_DIRECTIONS ? 0u : of.first_sample + number[j];
        for (uint k = 0; k < count; ++k) {
          const uint ray = j * count + k;
          keys.pixel[ray] = of.pixel, keys.sample[ray] = camera_sample, keys.seed[ray] = seed;
          keys.direction[ray] = of.first_direction + begin + k;
          keys.nx[ray] = normal.x, keys.ny[ray] = normal.y, keys.nz[ray] = normal.z;
          keys.vx[ray] = view.x, keys.vy[ray] = view.y, keys.vz[ray] = view.z;
          keys.exponent[ray] = exponent;
          origins.x[ray] = origin.x, origins.y[ray] = origin.y, origins.z[ray] = origin.z;
          if (ONLY_SELF) group[ray] = triangle_groups[point->triangle];
        }
      }
      float weight[STREAM];
      uint active;
      // A NaN normal or origin would pass for an open direction: no comparison with a NaN holds.
      sound &= make_directions(&keys, rays, &p, point_set, &directions, weight, &active);
      active &= sound;
      for (uint j = 0; j < found; ++j) {
        result[item[j]].rejected += popcount(~sound >> j * count & of_one);
        result[item[j]].rays += popcount(active >> j * count & of_one);
      }
      float visibility[STREAM];
      uint unreached = 0;
      for (uint j = 0, end; REACH && j < found; j = end) {
        for (end = j + 1u; p.directions < ASKED_ALONE && end < found && item[end] == item[j];) ++end;
        const uint together = (end == 32u ? 0xffffffffu : (1u << end) - 1u) & 0xffffffffu << j;
        // What was in reach of the first directions is in reach.
        const uint out = together & ~free ? 0u
                                          : unreached_rays(nodes, leaves AND_INSTANCE_ARGS, first_of_group, &asked,
                                                           together, count, &origins, &directions, active, &p);
        if (!out) free &= ~together;
        result[item[j]].rays -= popcount(out);
        unreached |= out;
      }
      active &= ~unreached;
      uint open = ONLY_SELF ? visible_within_groups(BVH_ARGS, first_of_group, group, &origins, &directions, active, &p,
                                                    visibility)
                            : visible_rays(BVH_ARGS, &origins, &directions, active, &p, visibility);
      if (FALLOFF != FALLOFF_NONE)
        for (uint rest = unreached; rest; rest &= rest - 1) visibility[lowest_bit(rest)] = 1.0f;
      open |= unreached;
      if (WEIGHTS_ARE_1) {
        for (uint j = 0; j < found; ++j) of_sample[j] += popcount(open >> j * count & of_one) * one;
        if (REPLICATE_DIRECTIONS)
          for (uint j = 0; j < found; ++j)
            result[item[j]].sum_square += popcount(open >> j * count & of_one) * square_of_one;
      }
      for (uint j = 0; (!WEIGHTS_ARE_1 || BENT) && j < found; ++j)
        for (uint rest = open & of_one << j * count; rest; rest &= rest - 1) {
          const uint ray = lowest_bit(rest);
          const float value = FALLOFF == FALLOFF_NONE ? weight[ray] : weight[ray] * visibility[ray];
          if (BENT) add_direction(bent_sum[item[j]], value * p.sum_scale, ray_direction(&directions, ray), &camera);
          if (WEIGHTS_ARE_1) continue;
          of_sample[j] += to_fixed_point(value * p.sum_scale);
          if (REPLICATE_DIRECTIONS) result[item[j]].sum_square += to_fixed_point(value * value * p.square_scale);
        }
    }
    for (uint j = 0; j < found; ++j) {
      result[item[j]].sum += of_sample[j];
      if (REACH) result[item[j]].free += free >> j & 1u;
      if (REPLICATE_DIRECTIONS) continue;
      const float mean = (float)of_sample[j] / (p.sum_scale * (float)p.directions);
      result[item[j]].sum_square += to_fixed_point(mean * mean * p.square_scale);
    }
  }
  for (uint i = 0; i < count_of_tasks; ++i) {
    results[first_task + i] = result[i];
    if (BENT)
      for (uint axis = 0; axis < 3; ++axis) bent[3 * (first_task + i) + axis] = bent_sum[i][axis];
  }
}
