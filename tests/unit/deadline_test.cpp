// Renders that end by time, in simulated time: a clock that only work moves, so that no load on the machine
// matters.
#include "trace/deadline.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace nook {
namespace {

constexpr std::uint64_t most = 1u << 22;

// A device of a given number of rays a second, two launches under way at any time; the first is slow besides,
// for it loads code. Returns when it has stopped.
double stops_at(double rays_per_second, double end) {
  double now = 0;
  Deadline deadline(end, [&now] { return now; });
  std::uint64_t rays = 0, under_way = deadline.launch_rays(most);
  now += 0.03;
  for (bool stopped = false; under_way > 0;) {
    const std::uint64_t next = stopped ? 0 : deadline.launch_rays(most);  // submitted before the wait
    now += double(under_way) / rays_per_second + 50e-6;
    rays += under_way;
    under_way = next;
    stopped = stopped || deadline.reached(rays);
  }
  return now;
}

TEST(Deadline, EndsWithinFivePercentOrAFifthOfASecond) {
  for (const double rate : {1e6, 3e6, 2e7, 1e8, 1e9})
    for (const double end : {.1, .3, 1., 5., 60.}) {
      const double at = stops_at(rate, end);
      EXPECT_NEAR(at, end, std::max(.05 * end, .2)) << rate << " rays a second";
      if (rate >= 3e6 && end >= .3) {
        EXPECT_NEAR(at, end, .03 * end) << rate << " rays a second";
      }
    }
}

// Launches stay large where the time allows it: each costs the device some 50 microseconds.
TEST(Deadline, LaunchesAreAsLargeAsTheTimeAllows) {
  double now = 0;
  Deadline deadline(100, [&now] { return now; });
  EXPECT_EQ(deadline.launch_rays(most), 1u << 16);
  std::uint64_t rays = 0;
  for (int launch = 0; launch < 4; ++launch) {
    now += .1;
    EXPECT_FALSE(deadline.reached(rays += 1000000));
  }
  EXPECT_EQ(deadline.launch_rays(most), 1000000u);
  now = 99.6;
  EXPECT_NEAR(double(deadline.launch_rays(most)), 500000, 2);
}

TEST(Deadline, WithoutOneLaunchesAreAsLargeAsTheyMay) {
  Deadline never;
  EXPECT_FALSE(never.reached(1));
  EXPECT_EQ(never.launch_rays(most), most);
}

}  // namespace
}  // namespace nook
