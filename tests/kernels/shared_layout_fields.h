// Fields of the structs that host and kernels share, for test_layout.cl and shared_layout_test.cpp: STRUCT(type), then its
// FIELD(type, name)s.
#define SHARED_LAYOUT(STRUCT, FIELD)                                                                                       \
  STRUCT(NodeOfKernel) FIELD(NodeOfKernel, lo) FIELD(NodeOfKernel, hi) FIELD(NodeOfKernel, nodes)                          \
  FIELD(NodeOfKernel, leaves) FIELD(NodeOfKernel, unused)                                                                  \
  STRUCT(TriangleLeaf) FIELD(TriangleLeaf, p) FIELD(TriangleLeaf, triangle) FIELD(TriangleLeaf, near_height)               \
  STRUCT(PlacedMesh) FIELD(PlacedMesh, point) FIELD(PlacedMesh, normal) FIELD(PlacedMesh, first_triangle)                  \
  FIELD(PlacedMesh, mesh_triangle) FIELD(PlacedMesh, root) FIELD(PlacedMesh, meshes)                                       \
  STRUCT(CutTriangle) FIELD(CutTriangle, uv) FIELD(CutTriangle, map) FIELD(CutTriangle, reserved)                          \
  STRUCT(OpacityMapPlace) FIELD(OpacityMapPlace, first) FIELD(OpacityMapPlace, width) FIELD(OpacityMapPlace, height)       \
  FIELD(OpacityMapPlace, clamped)                                                                                          \
  STRUCT(CameraParams) FIELD(CameraParams, eye) FIELD(CameraParams, width) FIELD(CameraParams, right)                      \
  FIELD(CameraParams, height) FIELD(CameraParams, up) FIELD(CameraParams, tan_half_fov_x) FIELD(CameraParams, forward)     \
  FIELD(CameraParams, tan_half_fov_y)                                                                                      \
  STRUCT(SurfacePoint) FIELD(SurfacePoint, origin) FIELD(SurfacePoint, flags) FIELD(SurfacePoint, normal)                  \
  FIELD(SurfacePoint, triangle) FIELD(SurfacePoint, view) FIELD(SurfacePoint, distance)                                    \
  FIELD(SurfacePoint, geometric_normal) FIELD(SurfacePoint, material)                                                      \
  STRUCT(Task) FIELD(Task, pixel) FIELD(Task, first_sample) FIELD(Task, first_direction) FIELD(Task, point)                \
  STRUCT(EstimatorParams) FIELD(EstimatorParams, samples) FIELD(EstimatorParams, directions)                               \
  FIELD(EstimatorParams, total_samples) FIELD(EstimatorParams, total_directions) FIELD(EstimatorParams, seed)              \
  FIELD(EstimatorParams, width) FIELD(EstimatorParams, max_distance) FIELD(EstimatorParams, exponent)                      \
  FIELD(EstimatorParams, sum_scale) FIELD(EstimatorParams, square_scale) FIELD(EstimatorParams, min_distance)              \
  FIELD(EstimatorParams, cone_sine) FIELD(EstimatorParams, cone_cosine)                                                    \
  STRUCT(TaskResult) FIELD(TaskResult, sum) FIELD(TaskResult, sum_square) FIELD(TaskResult, hits) FIELD(TaskResult, rays)  \
  FIELD(TaskResult, rejected) FIELD(TaskResult, free)
