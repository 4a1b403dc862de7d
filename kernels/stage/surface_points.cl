// The points that camera rays meet, as occlusion starts from them. As in directions.cl, what a point is made of stands in arrays, and
// the loop over them holds no branches, calls or vectors of three, so that a CPU's compiler makes 8 or 16 points at a time.
#ifndef NOOK_SURFACE_POINTS_CL
#define NOOK_SURFACE_POINTS_CL

#include "config.h"
#include "inline.h"
#include "trace/origin.cl"
#include "trace/rays.cl"
#include "shared/surface_point.h"
#include "trace/triangle.cl"

// Of each ray's hit: its triangle's corners in the world and their normals, and where it lies between them.
typedef struct {
  RayDirections corner[3], normal[3];
  float u[32], v[32];
  uint smooth[32];  // whether all corners have a normal
} SurfaceHits;

// What is computed of them.
typedef struct {
  RayDirections origin, normal, geometric_normal;
} SurfaceFrames;

INLINE void set_ray(RayDirections* of, uint k, float3 v) { of->x[k] = v.x, of->y[k] = v.y, of->z[k] = v.z; }

void clear_hits(SurfaceHits* hits) {
  for (uint corner = 0; corner < 3u; ++corner) clear_rays(&hits->corner[corner]), clear_rays(&hits->normal[corner]);
  for (uint k = 0; k < 32u; ++k) hits->u[k] = 0.0f;
  for (uint k = 0; k < 32u; ++k) hits->v[k] = 0.0f;
  for (uint k = 0; k < 32u; ++k) hits->smooth[k] = 0u;
}

INLINE void gather_hit(SurfaceHits* hits, uint k, TRIANGLE_PARAMS, __global const float* normals,
                       __global const uint* triangle_normals, uint triangle, float u, float v) {
  for (uint corner = 0; corner < 3u; ++corner) set_ray(&hits->corner[corner], k, vertex(TRIANGLE_ARGS, triangle, corner));
  hits->u[k] = u;
  hits->v[k] = v;
  if (!VERTEX_NORMALS) return;
  __global const uint* index = triangle_normals + 3 * STORED(triangle);
  hits->smooth[k] = index[0] != 0xffffffffu && index[1] != 0xffffffffu && index[2] != 0xffffffffu;
  for (uint corner = 0; hits->smooth[k] && corner < 3u; ++corner)
    set_ray(&hits->normal[corner], k, NORMAL_OF(triangle, load3(normals, index[corner])));
}

// The unit normal of triangle (a, b, c), from the edges at b: a loader leaves the longest one opposite. They are scaled first: those of a
// triangle of size 1e-15 would underflow.
INLINE void triangle_normal(Vector a, Vector b, Vector c, Vector* normal) {
  const Vector s = {c.x - b.x, c.y - b.y, c.z - b.z}, t = {a.x - b.x, a.y - b.y, a.z - b.z};
  const float scale = greater(greater(greater(fabs(s.x), fabs(t.x)), greater(fabs(s.y), fabs(t.y))),
                              greater(fabs(s.z), fabs(t.z)));
  const Vector e = {s.x / scale, s.y / scale, s.z / scale}, f = {t.x / scale, t.y / scale, t.z / scale};
  const Vector n = {e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
  const float inverse = 1.0f / sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  normal->x = n.x * inverse, normal->y = n.y * inverse, normal->z = n.z * inverse;
}

// Shading normal: the vertex normals interpolated, or the geometric normal where a corner has none or they cancel.
// Never flipped towards the viewer (TinyRender).
INLINE void shading_normal(const SurfaceHits* hits, uint k, Vector geometric, Vector* normal) {
  *normal = geometric;
  if (!VERTEX_NORMALS) return;
  const Vector a = ray_vector(&hits->normal[0], k), b = ray_vector(&hits->normal[1], k), c = ray_vector(&hits->normal[2], k);
  const float u = hits->u[k], v = hits->v[k], w = 1.0f - u - v;
  const Vector n = {w * a.x + u * b.x + v * c.x, w * a.y + u * b.y + v * c.y, w * a.z + u * b.z + v * c.z};
  const float length2 = n.x * n.x + n.y * n.y + n.z * n.z, inverse = 1.0f / sqrt(length2);
  const bool smooth = hits->smooth[k] && length2 > 1e-12f;
  normal->x = smooth ? n.x * inverse : geometric.x;
  normal->y = smooth ? n.y * inverse : geometric.y;
  normal->z = smooth ? n.z * inverse : geometric.z;
}

// Of the first `count` hits of rays from `eye`; of those behind them, and of rays that met nothing, any values. clear_hits() before
// the first.
INLINE void make_surface_frames(const SurfaceHits* hits, Vector eye, const RayDirections* d, const float* t, uint count,
                                SurfaceFrames* frames) {
  for (uint first = 0; first < count; first += RAYS_TOGETHER)
    for (uint k = first; k < first + RAYS_TOGETHER; ++k) {
      const Vector a = ray_vector(&hits->corner[0], k), b = ray_vector(&hits->corner[1], k), c = ray_vector(&hits->corner[2], k);
      Vector g, n, o;
      triangle_normal(a, b, c, &g);
      shading_normal(hits, k, g, &n);
      offset_origin(a, b, c, hits->u[k], hits->v[k], g, g.x * n.x + g.y * n.y + g.z * n.z, eye,
                    ray_vector(d, k), t[k], &o);
      frames->geometric_normal.x[k] = g.x, frames->geometric_normal.y[k] = g.y, frames->geometric_normal.z[k] = g.z;
      frames->normal.x[k] = n.x, frames->normal.y[k] = n.y, frames->normal.z[k] = n.z;
      frames->origin.x[k] = o.x, frames->origin.y[k] = o.y, frames->origin.z[k] = o.z;
    }
}

#endif
