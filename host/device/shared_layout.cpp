// The structs that host and kernels share (kernels/shared): no padding but what they name, so that both sides
// see the same bytes. tests/kernels/shared_layout_test.cpp asks a device for its own offsets.
#include <cstddef>
#include <type_traits>

#include "kernels/shared/bvh.h"
#include "kernels/shared/camera.h"
#include "kernels/shared/cut_out.h"
#include "kernels/shared/instance.h"
#include "kernels/shared/surface_point.h"
#include "kernels/shared/task.h"
#include "kernels/shared/task_result.h"

namespace nook {

template <class T, std::size_t bytes>
constexpr bool has_layout = std::is_trivially_copyable_v<T>&& std::is_standard_layout_v<T> &&
                            sizeof(T) == bytes;

static_assert(has_layout<BvhNode<16>, 7 * 64> && offsetof(BvhNode<16>, nodes) == 6 * 64);
static_assert(has_layout<BvhNode<8>, 4 * 64> && offsetof(BvhNode<8>, nodes) == 3 * 64);
static_assert(has_layout<TriangleLeaf, 4 * 64> && offsetof(TriangleLeaf, triangle) == 3 * 64);
static_assert(has_layout<PlacedMesh, 25 * 4> && offsetof(PlacedMesh, normal) == 12 * 4 &&
              offsetof(PlacedMesh, first_triangle) == 21 * 4);
static_assert(has_layout<CutTriangle, 8 * 4> && offsetof(CutTriangle, map) == 6 * 4);
static_assert(has_layout<OpacityMapPlace, 4 * 4>);
static_assert(has_layout<CameraParams, 16 * 4> && offsetof(CameraParams, forward) == 12 * 4);
static_assert(has_layout<SurfacePoint, 16 * 4> && offsetof(SurfacePoint, material) == 15 * 4);
static_assert(has_layout<Task, 4 * 4>);
static_assert(has_layout<EstimatorParams, 13 * 4> && offsetof(EstimatorParams, max_distance) == 6 * 4);
static_assert(has_layout<TaskResult, 2 * 8 + 4 * 4> && offsetof(TaskResult, hits) == 2 * 8);

}  // namespace nook
