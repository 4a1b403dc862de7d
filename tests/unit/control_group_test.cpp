#include "base/control_group.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/temporary_folder.hpp"

namespace nook {
namespace {

class ControlGroupsTest : public testing::Test {
 protected:
  void put(const std::string& file, const std::string& text) {
    std::filesystem::create_directories((folder / file).parent_path());
    test::write_bytes(folder / file, text);
  }
  ControlGroups groups(const std::string& own) {
    put("own", own);
    return ControlGroups(folder / "mounted", folder / "own");
  }
  test::TemporaryFolder folder;
};

TEST_F(ControlGroupsTest, WithoutLimitsAreUnlimited) {
  const ControlGroups none = groups("");
  EXPECT_EQ(none.memory(), unlimited);
  EXPECT_TRUE(std::isinf(none.processors()));
  put("mounted/a/cpu.max", "max 100000\n");
  put("mounted/a/memory.max", "max\n");
  put("mounted/a/memory.current", "4096\n");
  EXPECT_EQ(groups("0::/a\n").memory(), unlimited);
  EXPECT_TRUE(std::isinf(groups("0::/a\n").processors()));
}

// The job's own limit is wide, that of the slice above it is not.
TEST_F(ControlGroupsTest, OfVersion2HaveTheLeastLimitOnTheWayUp) {
  put("mounted/batch/job/cpu.max", "800000 100000\n");
  put("mounted/batch/job/memory.max", "max\n");
  put("mounted/batch/job/memory.current", "10\n");
  put("mounted/batch/cpu.max", "150000 100000\n");
  put("mounted/batch/memory.max", "1000\n");
  put("mounted/batch/memory.current", "400\n");
  EXPECT_EQ(groups("0::/batch/job\n").processors(), 1.5);
  EXPECT_EQ(groups("0::/batch/job\n").memory(), 600u);
  EXPECT_TRUE(std::isinf(groups("0::/elsewhere\n").processors()));
}

// A container is told the name that its group has outside, and sees it as the root.
TEST_F(ControlGroupsTest, OfAContainerAreTheRoot) {
  put("mounted/cpu.max", "50000 100000\n");
  EXPECT_EQ(groups("0::/docker/4f2a\n").processors(), .5);
}

TEST_F(ControlGroupsTest, OfVersion1AreOfTheirController) {
  put("mounted/cpu/lxc/cpu.cfs_quota_us", "300000\n");
  put("mounted/cpu/lxc/cpu.cfs_period_us", "100000\n");
  put("mounted/cpu/cpu.cfs_quota_us", "-1\n");
  put("mounted/cpu/cpu.cfs_period_us", "100000\n");
  put("mounted/memory/lxc/memory.limit_in_bytes", "5000\n");
  put("mounted/memory/lxc/memory.usage_in_bytes", "6000\n");
  const ControlGroups both = groups("9:cpu,cpuacct:/lxc\n8:memory:/lxc\n");
  EXPECT_EQ(both.processors(), 3);
  EXPECT_EQ(both.memory(), 0u) << "more is used than allowed";
  EXPECT_TRUE(std::isinf(groups("9:cpuset:/lxc\n").processors()));
}

}  // namespace
}  // namespace nook
