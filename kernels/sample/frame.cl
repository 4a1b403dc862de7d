// Orthonormal basis about a unit vector, without branches or singularities.
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited" (JCGT 6(1)). copysign keeps -0 on the lower branch.
#ifndef NOOK_FRAME_CL
#define NOOK_FRAME_CL

typedef struct {
  float3 tangent, bitangent, normal;  // unit, right-handed
} Frame;

Frame frame_about(float3 normal) {
  float sign = copysign(1.0f, normal.z);
  float a = -1.0f / (sign + normal.z);
  float b = normal.x * normal.y * a;
  Frame frame;
  frame.tangent = (float3)(1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
  frame.bitangent = (float3)(b, sign + normal.y * normal.y * a, -normal.y);
  frame.normal = normal;
  return frame;
}

// A vector given in the frame's coordinates (z along the normal), in world coordinates.
float3 to_world(const Frame* frame, float3 v) {
  return (float3)(v.x * frame->tangent.x + v.y * frame->bitangent.x + v.z * frame->normal.x,
                  v.x * frame->tangent.y + v.y * frame->bitangent.y + v.z * frame->normal.y,
                  v.x * frame->tangent.z + v.y * frame->bitangent.z + v.z * frame->normal.z);
}

// The inverse of to_world: a world vector in the frame's coordinates.
float3 to_local(const Frame* frame, float3 v) {
  return (float3)(dot(v, frame->tangent), dot(v, frame->bitangent), dot(v, frame->normal));
}

#endif
