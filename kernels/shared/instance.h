// A mesh placed in the scene (an instance), and the arithmetic that places it. Host and kernels compile the same text: a
// copy that the host makes of the mesh and an instance that a kernel places have the same bits.
#ifndef NOOK_SHARED_INSTANCE_H
#define NOOK_SHARED_INSTANCE_H

#include "portable.h"

#ifdef __OPENCL_C_VERSION__
#define NOOK_INLINE __attribute__((unused)) static inline
#define NOOK_FMA fma
#define NOOK_FLOAT_OF_BITS as_float
#define NOOK_BITS_OF_FLOAT as_uint
#else
#include <bit>
#include <cmath>
#define NOOK_INLINE inline
#define NOOK_FMA std::fma
#define NOOK_FLOAT_OF_BITS std::bit_cast<float>
#define NOOK_BITS_OF_FLOAT std::bit_cast<nook_uint>
#endif

// Read as:
//   world[axis] = PLACED(point[axis], x, y, z);  triangle t of the scene is the mesh buffers' t - first_triangle + mesh_triangle
typedef struct {
  float point[3][4];          // linear part and translation, by rows
  float normal[3][3];         // of the directions that normals get: a multiple of the inverse transpose of the linear part
  nook_uint first_triangle;   // the number, in the scene, of its first triangle
  nook_uint mesh_triangle;    // where that triangle is in the mesh buffers
  nook_uint root;             // the node that its mesh's tree starts at
  nook_uint meshes;           // how many placed meshes the scene has: the same in each
} PlacedMesh;

// A coordinate of a placed point, row = (m0, m1, m2, m3): m0 x + m1 y + m2 z + m3. Each fma is monotone in each of its arguments
// (rounding is), so is the whole: the same expression at the fitting corners of a box bounds it over all points of the box.
#define PLACED(row, x, y, z) NOOK_FMA((row)[0], (x), NOOK_FMA((row)[1], (y), NOOK_FMA((row)[2], (z), (row)[3])))

typedef struct {
  float x, y, z;
} PlacedNormal;

// v / |v| to a few ulp; 0 for a vector without direction. Products, fma and integers alone, for a square root and a division
// may differ between devices. |v| <= 4.
NOOK_INLINE PlacedNormal unit_vector(float x, float y, float z) {
  const float ax = x < 0.0f ? -x : x, ay = y < 0.0f ? -y : y, az = z < 0.0f ? -z : z;
  const float most = ax > ay ? (ax > az ? ax : az) : (ay > az ? ay : az);
  const nook_uint exponent = NOOK_BITS_OF_FLOAT(most) >> 23;
  if (!(most <= 4.0f) || exponent == 0) {
    const PlacedNormal none = {0.0f, 0.0f, 0.0f};
    return none;
  }
  const float scale = NOOK_FLOAT_OF_BITS((254u - exponent) << 23);  // a power of 2: the largest is in [1, 2)
  const float sx = scale * x, sy = scale * y, sz = scale * z;
  const float square = NOOK_FMA(sx, sx, NOOK_FMA(sy, sy, sz * sz));
  // 1 / sqrt(square) by Newton's method, from a guess that is 3.4 % off at most; each step squares that.
  float inverse = NOOK_FLOAT_OF_BITS(0x5f3759dfu - (NOOK_BITS_OF_FLOAT(square) >> 1));
  for (int step = 0; step < 4; ++step) {
    const float half_root = 0.5f * square * inverse;
    inverse = NOOK_FMA(inverse, NOOK_FMA(-half_root, inverse, 0.5f), inverse);
  }
  const PlacedNormal unit = {sx * inverse, sy * inverse, sz * inverse};
  return unit;
}

// A unit normal of a placed mesh; rows: PlacedMesh.normal.
#define PLACED_NORMAL(rows, x, y, z)                                                           \
  unit_vector(NOOK_FMA((rows)[0][0], (x), NOOK_FMA((rows)[0][1], (y), (rows)[0][2] * (z))), \
              NOOK_FMA((rows)[1][0], (x), NOOK_FMA((rows)[1][1], (y), (rows)[1][2] * (z))), \
              NOOK_FMA((rows)[2][0], (x), NOOK_FMA((rows)[2][1], (y), (rows)[2][2] * (z))))

#endif
