// Host and device see the same bytes in the structs that they share.
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <iterator>

#include "device/kernel_source.hpp"
#include "kernels/shared/bvh.h"
#include "kernels/shared/camera.h"
#include "kernels/shared/cut_out.h"
#include "kernels/shared/instance.h"
#include "kernels/shared/surface_point.h"
#include "kernels/shared/task.h"
#include "kernels/shared/task_result.h"
#include "plan/kernel_arguments.hpp"
#include "shared_layout_fields.h"
#include "support/kernels.hpp"

namespace nook::test {
namespace {

struct Place {
  const char* name;
  std::size_t bytes;
};

template <unsigned width>
std::vector<Place> places_on_host() {
  using NodeOfKernel = BvhNode<width>;
  std::vector<Place> places;
#define SIZE(type) places.push_back({#type, sizeof(type)});
#define OFFSET(type, name) places.push_back({#type "." #name, offsetof(type, name)});
  SHARED_LAYOUT(SIZE, OFFSET)
#undef SIZE
#undef OFFSET
  return places;
}

std::string with_fields(const std::string& kernel) {
  std::ifstream fields(NOOK_SOURCE_DIR "/tests/kernels/shared_layout_fields.h");
  return std::string(std::istreambuf_iterator<char>(fields), {}) + kernel;
}

std::vector<std::uint32_t> places_on_device(unsigned width, const std::string& source) {
  TestProgram program(source, BuildOptions().define("BVH_WIDTH", width));
  std::vector<std::uint32_t> out(128);
  program.run("layout", 1, InOut<std::uint32_t>{out});
  return out;
}

template <unsigned width>
void expect_the_same() {
  const std::vector<Place> host = places_on_host<width>();
  const std::vector<std::uint32_t> device =
      places_on_device(width, with_fields(test_kernel_source("test_layout.cl")));
  ASSERT_EQ(device[0], host.size());
  for (std::size_t i = 0; i < host.size(); ++i) EXPECT_EQ(device[i + 1], host[i].bytes) << host[i].name;
}

TEST(SharedLayout, IsTheDevicesOwn) {
  expect_the_same<16>();
  expect_the_same<8>();
}

TEST(SharedLayout, AStructThatHidesPaddingIsFound) {
  std::string source = with_fields(test_kernel_source("test_layout.cl"));
  const std::string field = "float tan_half_fov_x;";
  source.replace(source.find(field), field.size(), "double tan_half_fov_x;");
  const std::vector<std::uint32_t> device = places_on_device(16, source);
  const std::vector<Place> host = places_on_host<16>();
  std::size_t different = 0;
  for (std::size_t i = 0; i < host.size(); ++i) different += device[i + 1] != host[i].bytes;
  EXPECT_GT(different, 0u);
}

// The kernels' parameters are those that the host adds (kernels/shared/arguments.h).
TEST(KernelArguments, AreAsManyAsTheKernelTakes) {
  for (const bool cutouts : {false, true})
    for (const bool instances : {false, true}) {
      Plan plan;
      plan.cutouts = cutouts;
      plan.instances = instances;
      for (const KernelPlan& kernel : {primary_kernel(plan), occlusion_kernel(plan, EffectPlan{})}) {
        const BuiltProgram program = build_program(device(), kernel_source(kernel.file), kernel.options);
        const ClKernel built = program.kernel(kernel.entry.c_str());
        cl_uint taken = 0;
        check_opencl(opencl().clGetKernelInfo(built.get(), CL_KERNEL_NUM_ARGS, sizeof taken, &taken, nullptr),
                     "info");
        EXPECT_EQ(taken, argument_names(plan, kernel.entry).size()) << kernel.entry;
      }
    }
}

TEST(KernelArguments, OneThatIsMissingIsNamed) {
  const Plan plan;
  const KernelPlan kernel = primary_kernel(plan);
  const BuiltProgram program = build_program(device(), kernel_source(kernel.file), kernel.options);
  const ClKernel built = program.kernel(kernel.entry.c_str());
  const ClBuffer some = device().buffer(4);
  TreeArguments tree;
  tree.nodes = some.get();
  KernelCall call(built);
  try {
    add_arguments(call, plan, tree);
    FAIL() << "leaves are missing";
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("leaves"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace nook::test
