// A stream's rays as the vector tests read them.
#ifndef NOOK_STREAM_RAYS_CL
#define NOOK_STREAM_RAYS_CL

#include "trace/intersect.cl"
#include "trace/stream_vector.cl"

// What the tests read of each ray. Offsets count floats.
typedef struct {
  float ox[32], oy[32], oz[32];             // origins
  float dx[32], dy[32], dz[32];
  float ix[32], iy[32], iz[32];             // 1/d
  uint near_x[32], near_y[32], near_z[32];  // BvhNode planes that the ray enters through
  float shear_x[32], shear_y[32];           // RayShear
  uint row_x[32], row_y[32], row_z[32];     // TriangleLeaf.p: rows of the RayShear axes
  float row_ox[32], row_oy[32], row_oz[32];  // the origin along them
  float inverse_z[32];                      // 1/d[kz]
  float limit_z[32];                        // max_distance |d[kz]|
} StreamRays;

#define HI_PLANES (3u * BVH_WIDTH)    // BvhNode.hi behind BvhNode.lo
#define SIGN_BIT 0x80000000u

// Rays [first, first + 16), as shear_ray() does it for one.
void prepare_rays(StreamRays* r, const RayDirections* origins, const RayDirections* d, uint first, float max_distance) {
  const float16 ox = vload16(0, origins->x + first), oy = vload16(0, origins->y + first), oz = vload16(0, origins->z + first);
  const float16 x = vload16(0, d->x + first), y = vload16(0, d->y + first), z = vload16(0, d->z + first);
  const float16 ix = 1.0f / x, iy = 1.0f / y, iz = 1.0f / z;
  STORE_FLOATS(r->ox + first, ox);
  STORE_FLOATS(r->oy + first, oy);
  STORE_FLOATS(r->oz + first, oz);
  STORE_FLOATS(r->dx + first, x);
  STORE_FLOATS(r->dy + first, y);
  STORE_FLOATS(r->dz + first, z);
  STORE_FLOATS(r->ix + first, ix);
  STORE_FLOATS(r->iy + first, iy);
  STORE_FLOATS(r->iz + first, iz);
  const uint16 hi = HI_PLANES, none = 0u;
  STORE_UINTS(r->near_x + first, as_int16(ix) < 0 ? hi : none);
  STORE_UINTS(r->near_y + first, (as_int16(iy) < 0 ? hi : none) + BVH_WIDTH);
  STORE_UINTS(r->near_z + first, (as_int16(iz) < 0 ? hi : none) + 2u * BVH_WIDTH);
  const float16 ax = fabs(x), ay = fabs(y), az = fabs(z);
  const int16 along_z = (az >= ax) & (az >= ay), along_y = ay >= ax;
  const float16 inverse_z = along_z ? iz : along_y ? iy : ix;
  STORE_FLOATS(r->inverse_z + first, inverse_z);
  STORE_FLOATS(r->shear_x + first, -((along_z ? x : along_y ? z : y) * inverse_z));
  STORE_FLOATS(r->shear_y + first, -((along_z ? y : along_y ? x : z) * inverse_z));
  STORE_FLOATS(r->limit_z + first, max_distance * (along_z ? az : along_y ? ay : ax));
  const uint16 row1 = (uint16)(2u * BVH_LEAF_WIDTH), row2 = (uint16)(4u * BVH_LEAF_WIDTH);
  STORE_UINTS(r->row_z + first, along_z ? row2 : along_y ? row1 : none);
  STORE_UINTS(r->row_x + first, along_z ? none : along_y ? row2 : row1);
  STORE_UINTS(r->row_y + first, along_z ? row1 : along_y ? none : row2);
  STORE_FLOATS(r->row_oz + first, along_z ? oz : along_y ? oy : ox);
  STORE_FLOATS(r->row_ox + first, along_z ? ox : along_y ? oz : oy);
  STORE_FLOATS(r->row_oy + first, along_z ? oy : along_y ? ox : oz);
}

void prepare_stream(StreamRays* r, const RayDirections* origins, const RayDirections* d, uint active, float max_distance) {
  for (uint first = 0; first < 32 && active >> first; first += 16) prepare_rays(r, origins, d, first, max_distance);
}

INLINE float least_lane(float16 v) {
  const float8 a = v.lo < v.hi ? v.lo : v.hi;
  const float4 b = a.lo < a.hi ? a.lo : a.hi;
  const float2 c = b.lo < b.hi ? b.lo : b.hi;
  return min_or_second(c.x, c.y);
}

INLINE float most_lane(float16 v) { return -least_lane(-v); }

INLINE int16 lanes_of(uint rays) { return ((int16)(int)rays & LANE_BITS) != 0; }

#endif
