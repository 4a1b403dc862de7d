// A node of the tree has as many children as the device's vectors have floats; trees are refined for many
// rays.
#include <gtest/gtest.h>

#include "plan/tree_options.hpp"

namespace nook {
namespace {

unsigned width_of(cl_device_type type, unsigned native_float_width, const Plan& plan = {}) {
  DeviceInfo device;
  device.type = type;
  device.native_float_width = native_float_width;
  return tree_width(device, plan);
}

TEST(TreeWidth, FollowsTheVectorsOfAProcessor) {
  EXPECT_EQ(width_of(CL_DEVICE_TYPE_CPU, 32), 16u);
  EXPECT_EQ(width_of(CL_DEVICE_TYPE_CPU, 16), 16u);  // AVX-512
  EXPECT_EQ(width_of(CL_DEVICE_TYPE_CPU, 8), 8u);    // AVX
  EXPECT_EQ(width_of(CL_DEVICE_TYPE_CPU, 4), 8u);    // SSE, NEON
  EXPECT_EQ(width_of(CL_DEVICE_TYPE_CPU, 1), 8u);
}

TEST(TreeWidth, IsThatOfSingleRaysElsewhere) {
  for (const unsigned vectors : {1u, 4u, 16u}) EXPECT_EQ(width_of(CL_DEVICE_TYPE_GPU, vectors), 16u);
}

// Else the two trees would stop a pixel at different counts.
TEST(TreeWidth, IsTheSameForAllWhereAPlanAsksWhatIsInReach) {
  Plan plan;
  plan.effects.resize(2);
  EXPECT_EQ(width_of(CL_DEVICE_TYPE_CPU, 8, plan), 8u);
  plan.effects[1].reach = true;
  EXPECT_EQ(width_of(CL_DEVICE_TYPE_CPU, 8, plan), 16u);
}

TEST(TreeOptions, RefineForManyRaysAlone) {
  Plan plan;
  plan.window = {0, 0, 1024, 1024};
  plan.effects.resize(1);
  const auto refined = [&] { return tree_options(DeviceInfo(), plan, planned_rays(plan), 3).refined; };
  plan.directions = 16;
  EXPECT_FALSE(refined());
  plan.directions = 64;
  EXPECT_TRUE(refined());
  plan.directions = 8, plan.spp = 8;
  EXPECT_TRUE(refined());
  plan.instances = true;  // a refinement for each mesh
  EXPECT_FALSE(refined());
  plan.instances = false;
  plan.effects[0].reach = true;  // what it is told depends on the tree
  EXPECT_FALSE(refined());
}

}  // namespace
}  // namespace nook
