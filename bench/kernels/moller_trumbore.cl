#include "trace/stream_tests.cl"

// A triangle test that is not watertight, to be measured in place of leaf_occludes() (kernels/trace/stream_tests.cl): Möller and Trumbore
// 1997, "Fast, Minimum Storage Ray-Triangle Intersection". o + t d = p0 + u (p1 - p0) + v (p2 - p0); multiplied by det instead of divided.
// -1 in the lanes of triangles that ray k meets at 0 < t < limit, else 0.
INLINE leaf_int leaf_occludes_loosely(TREE_LEAF* leaf, const RayDirections* o, const RayDirections* d, uint k, float limit) {
  const float16 x = vload16(0, leaf->p[0]), y = vload16(0, leaf->p[1]), z = vload16(0, leaf->p[2]);
  const leaf_float ax = FIRST_CORNERS(x), ay = FIRST_CORNERS(y), az = FIRST_CORNERS(z);
  const leaf_float e1x = SECOND_CORNERS(x) - ax, e1y = SECOND_CORNERS(y) - ay, e1z = SECOND_CORNERS(z) - az;
  const leaf_float e2x = THIRD_CORNERS(x) - ax, e2y = THIRD_CORNERS(y) - ay, e2z = THIRD_CORNERS(z) - az;
  const leaf_float dx = d->x[k], dy = d->y[k], dz = d->z[k];
  const leaf_float px = fma(dy, e2z, -dz * e2y), py = fma(dz, e2x, -dx * e2z), pz = fma(dx, e2y, -dy * e2x);
  const leaf_float det = fma(e1x, px, fma(e1y, py, e1z * pz));
  const leaf_float sx = o->x[k] - ax, sy = o->y[k] - ay, sz = o->z[k] - az;
  const leaf_float qx = fma(sy, e1z, -sz * e1y), qy = fma(sz, e1x, -sx * e1z), qz = fma(sx, e1y, -sy * e1x);
  const leaf_uint sign = AS_LEAF_UINT(det) & SIGN_BIT;
  const leaf_float size = fabs(det);
  const leaf_float u = AS_LEAF_FLOAT(AS_LEAF_UINT(fma(sx, px, fma(sy, py, sz * pz))) ^ sign);
  const leaf_float v = AS_LEAF_FLOAT(AS_LEAF_UINT(fma(dx, qx, fma(dy, qy, dz * qz))) ^ sign);
  const leaf_float t = AS_LEAF_FLOAT(AS_LEAF_UINT(fma(e2x, qx, fma(e2y, qy, e2z * qz))) ^ sign);
  return (u >= 0.0f) & (v >= 0.0f) & (u + v <= size) & (t > 0.0f) & (t < limit * size);
}

