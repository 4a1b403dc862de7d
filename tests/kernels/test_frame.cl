// frame_about at given normals, and a vector there and back.
#include "sample/frame.cl"

// out: tangent, bitangent, normal, to_world(v), to_local(to_world(v)); 15 floats for each normal.
__kernel void frame_at(__global const float* normals, __global const float* vectors, __global float* out) {
  uint i = get_global_id(0);
  Frame frame = frame_about(vload3(i, normals));
  float3 world = to_world(&frame, vload3(i, vectors));
  vstore3(frame.tangent, 5 * i, out);
  vstore3(frame.bitangent, 5 * i + 1, out);
  vstore3(frame.normal, 5 * i + 2, out);
  vstore3(world, 5 * i + 3, out);
  vstore3(to_local(&frame, world), 5 * i + 4, out);
}
