// Closest hits of a packet (traverse_packet.cl): rays of one origin that agree in their directions' signs and in their longest axis, as
// the camera rays of a pixel do. Here the rays are the vectors' lanes: a node's children are first tested all at once against the
// interval that holds every ray,
//   near distance >= min over the ends of [least, most] of (plane - o) / d,   far distance <= max of the same,
// where rounding is monotone, so that the interval meets whatever box a ray meets; each child that it meets is then tested against
// the rays as enter_box() does, and each triangle of a leaf as triangle_nearer() does. So the bits are those of one ray alone.
#ifndef NOOK_PACKET_TESTS_CL
#define NOOK_PACKET_TESTS_CL

#include "trace/stream_tests.cl"

#if !INSTANCES

#define GROUP 16u  // rays in a vector; a packet is one or two of them
#define GROUP_RAYS 0xffffu
#define FEW_RAYS 6u  // up to this number, rays meet a leaf faster one by one, its triangles as lanes

typedef struct {
  float3 origin;
  float3 least, most;                  // of the rays' 1/d
  uint near_x, near_y, near_z;         // as in StreamRays
  uint row_x, row_y, row_z;
  float row_ox, row_oy, row_oz;
} Packet;

// The interval of one component of 1/d over the rays of `active`; whether it is finite and of one sign.
INLINE bool interval_of(const float* inverse, uint active, float* least, float* most) {
  float16 low = INFINITY, high = -INFINITY;
  for (uint first = 0; first < 32u && active >> first; first += GROUP) {
    const int16 lanes = lanes_of(active >> first);
    const float16 v = vload16(0, inverse + first);
    const float16 a = lanes ? v : low, b = lanes ? v : high;
    low = a < low ? a : low;
    high = b > high ? b : high;
  }
  *least = least_lane(low);
  *most = most_lane(high);
  return isfinite(*least) && isfinite(*most) && (*least > 0.0f || *most < 0.0f);
}

// Whether the rays of `active` (at least one), which share their origin, are a packet.
INLINE bool make_packet(const StreamRays* r, uint active, Packet* p) {
  float least_x, least_y, least_z, most_x, most_y, most_z;
  if (!interval_of(r->ix, active, &least_x, &most_x) || !interval_of(r->iy, active, &least_y, &most_y) ||
      !interval_of(r->iz, active, &least_z, &most_z))
    return false;
  const uint k = LOWEST_BIT(active);
  uint others = 0;  // rays whose longest axis is another
  for (uint first = 0; first < 32u && active >> first; first += GROUP)
    others |= NONZERO_LANES(vload16(0, r->row_z + first) != r->row_z[k]) << first;
  if (others & active) return false;
  p->origin = (float3)(r->ox[k], r->oy[k], r->oz[k]);
  p->least = (float3)(least_x, least_y, least_z);
  p->most = (float3)(most_x, most_y, most_z);
  p->near_x = r->near_x[k], p->near_y = r->near_y[k], p->near_z = r->near_z[k];
  p->row_x = r->row_x[k], p->row_y = r->row_y[k], p->row_z = r->row_z[k];
  p->row_ox = r->row_ox[k], p->row_oy = r->row_oy[k], p->row_oz = r->row_oz[k];
  return true;
}

// The children that the interval meets within [0, limit], and where it enters them at the earliest.
INLINE uint children_met(__global const BvhNode* node, const Packet* p, float limit, node_float* entry) {
  __global const float* planes = &node->lo[0][0];
  node_float enter = 0.0f, leave = limit;
#define SLAB(axis, base)                                                                                              \
  {                                                                                                                   \
    const node_float a = LOAD_NODE(planes + p->near_##axis) - p->origin.axis;                                         \
    const node_float b = LOAD_NODE(planes + (HI_PLANES + 2u * (base) * BVH_WIDTH - p->near_##axis)) - p->origin.axis; \
    const node_float a0 = a * p->least.axis, a1 = a * p->most.axis, b0 = b * p->least.axis, b1 = b * p->most.axis;    \
    const node_float near_distance = a0 < a1 ? a0 : a1, far_distance = b0 > b1 ? b0 : b1;                             \
    enter = near_distance > enter ? near_distance : enter;                                                            \
    leave = far_distance < leave ? far_distance : leave;                                                              \
  }
  SLAB(x, 0u)
  SLAB(y, 1u)
  SLAB(z, 2u)
#undef SLAB
  *entry = enter;
  return NONZERO_CHILDREN(enter <= leave * FAR_PLANE_GROWTH);
}

// enter_box() for one child and the rays of `rays`: those that meet it within [0, t].
INLINE uint rays_met(__global const BvhNode* node, uint lane, const StreamRays* r, const Packet* p, uint rays, const float* t) {
  __global const float* planes = &node->lo[0][lane];
  const float ax = planes[p->near_x] - p->origin.x, bx = planes[HI_PLANES - p->near_x] - p->origin.x;
  const float ay = planes[p->near_y] - p->origin.y, by = planes[HI_PLANES + 2u * BVH_WIDTH - p->near_y] - p->origin.y;
  const float az = planes[p->near_z] - p->origin.z, bz = planes[HI_PLANES + 4u * BVH_WIDTH - p->near_z] - p->origin.z;
  uint met = 0;
  for (uint first = 0; first < 32u && rays >> first; first += GROUP) {
    const float16 ix = vload16(0, r->ix + first), iy = vload16(0, r->iy + first), iz = vload16(0, r->iz + first);
    float16 enter = 0.0f, leave = vload16(0, t + first);
    enter = ax * ix > enter ? ax * ix : enter;
    leave = bx * ix < leave ? bx * ix : leave;
    enter = ay * iy > enter ? ay * iy : enter;
    leave = by * iy < leave ? by * iy : leave;
    enter = az * iz > enter ? az * iz : enter;
    leave = bz * iz < leave ? bz * iz : leave;
    met |= NONZERO_LANES(enter <= leave * FAR_PLANE_GROWTH) << first;
  }
  return met & rays;
}

// A leaf's points, from the packet's origin along the axes of its shear.
typedef struct {
  float x[2 * BVH_LEAF_WIDTH], y[2 * BVH_LEAF_WIDTH], z[2 * BVH_LEAF_WIDTH];
} LeafFromOrigin;

INLINE void move_to_origin(LeafFromOrigin* from, __global const TriangleLeaf* leaf, const Packet* p) {
  __global const float* points = &leaf->p[0][0];
  STORE_FLOATS(from->x, vload16(0, points + p->row_x) - p->row_ox);
  STORE_FLOATS(from->y, vload16(0, points + p->row_y) - p->row_oy);
  STORE_FLOATS(from->z, vload16(0, points + p->row_z) - p->row_oz);
}

// triangle_nearer() for one triangle and the 16 rays from `first` on.
INLINE void meet_triangle(__global const TriangleLeaf* leaf, const LeafFromOrigin* from, uint lane, const StreamRays* r, uint first,
                          uint rays, float* t, uint* triangle, float* u, float* v) {
  const uint id = leaf->triangle[lane];
  const float16 sx = vload16(0, r->shear_x + first), sy = vload16(0, r->shear_y + first);
  const uint a = BVH_CORNER(0, lane), b = BVH_CORNER(1, lane), c = BVH_CORNER(2, lane);
  const float az = from->z[a], bz = from->z[b], cz = from->z[c];
  const float16 ax = fma(sx, (float16)(az), (float16)(from->x[a])), ay = fma(sy, (float16)(az), (float16)(from->y[a]));
  const float16 bx = fma(sx, (float16)(bz), (float16)(from->x[b])), by = fma(sy, (float16)(bz), (float16)(from->y[b]));
  const float16 cx = fma(sx, (float16)(cz), (float16)(from->x[c])), cy = fma(sy, (float16)(cz), (float16)(from->y[c]));
  const float16 wa = cx * by - cy * bx, wb = ax * cy - ay * cx, wc = bx * ay - by * ax;
  const float16 det = wa + wb + wc;
  const uint16 sign = as_uint16(det) & SIGN_BIT;
  const int16 inside = (as_float16(as_uint16(wa) ^ sign) >= 0.0f) & (as_float16(as_uint16(wb) ^ sign) >= 0.0f) &
                       (as_float16(as_uint16(wc) ^ sign) >= 0.0f);
  if (!(NONZERO_LANES(inside) & rays)) return;
  const float16 height = fma(wa, (float16)(az), fma(wb, (float16)(bz), wc * cz));
  float16 distance = height * vload16(0, r->inverse_z + first) / det;
  const float16 least = leaf->near_height[lane];
  uint near = NONZERO_LANES(inside & (det != 0.0f) & (fabs(height) <= (distance < 0.0f ? least : NEAR_HITS * least))) & rays;
  if (near) {
    float placed[GROUP];
    STORE_FLOATS(placed, distance);
    for (; near; near &= near - 1) placed[LOWEST_BIT(near)] = lane_distance(leaf, lane, r, first + LOWEST_BIT(near));
    distance = vload16(0, placed);
  }
  const float16 limit = vload16(0, t + first);
  const uint16 found = vload16(0, triangle + first);
  // Of equally near triangles the lowest index, as closest_ray(); none at the limit itself.
  const int16 nearer = inside & (distance > 0.0f) & lanes_of(rays) &
                       ((distance < limit) | ((distance == limit) & (found != NO_TRIANGLE) & (found > id)));
  if (!NONZERO_LANES(nearer)) return;
  STORE_FLOATS(t + first, nearer ? distance : limit);
  STORE_UINTS(triangle + first, nearer ? (uint16)(id) : found);
  STORE_FLOATS(u + first, nearer ? wb / det : vload16(0, u + first));
  STORE_FLOATS(v + first, nearer ? wc / det : vload16(0, v + first));
}

#endif

#endif
