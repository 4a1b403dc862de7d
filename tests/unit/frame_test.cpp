// Where a mesh lies in memory: near 0 and of a size that floats have room about, however the file has it.
#include "math/frame.hpp"

#include <gtest/gtest.h>

#include "mesh/load_mesh.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

TEST(Frame, OrdinaryScenesKeepTheirCoordinates) {
  EXPECT_EQ(frame_for(dvec3(-1), dvec3(1)), Frame());
  EXPECT_EQ(frame_for(dvec3(0), dvec3(5, 1, 3)), Frame());
  EXPECT_EQ(frame_for(dvec3(9), dvec3(11)), Frame());
  EXPECT_EQ(frame_for(dvec3(-1e6), dvec3(1e6)), Frame());
  EXPECT_EQ(frame_for(dvec3(3), dvec3(3)), Frame());                 // a point
  EXPECT_EQ(frame_for(dvec3(HUGE_VAL), dvec3(-HUGE_VAL)), Frame());  // nothing
}

TEST(Frame, MapCoordinatesAreMovedByRoundNumbers) {
  const Frame frame = frame_for({388094, 8, 3948990}, {388098, 12, 3949002});
  EXPECT_EQ(frame.exponent, 0);
  EXPECT_EQ(frame.center, dvec3(388096, 8, 3948992));
  EXPECT_EQ(frame.to_file(frame.from_file(dvec3(388096.125, 10.5, 3948996.25))),
            dvec3(388096.125, 10.5, 3948996.25));
}

TEST(Frame, SizesBeyondAMillionAreMovedByPowersOfTwo) {
  const Frame small = frame_for(dvec3(-std::ldexp(1.5, -100)), dvec3(std::ldexp(1.5, -100)));
  EXPECT_EQ(small.exponent, -100);
  EXPECT_EQ(small.from_file(std::ldexp(1.5, -100)), 1.5);
  const Frame large = frame_for(dvec3(-1e30), dvec3(1e30));
  EXPECT_EQ(large.exponent, 99);
  EXPECT_EQ(large.to_file(1.0), std::ldexp(1.0, 99));
}

// A step of 5 cm that floats cannot tell from its neighbours.
TEST(Frame, AFilesDigitsAreKept) {
  const test::TemporaryFolder folder;
  const auto file = folder / "step.obj";
  test::write_bytes(
      file,
      "v 388096.05 10.05 3948996.05\nv 388096.10 10.05 3948996.05\nv 388096.10 10.10 3948996.05\n"
      "f 1 2 3\n");
  const TriangleMesh mesh = load_mesh(file);
  EXPECT_NE(mesh.frame, Frame());
  const vec3 size = mesh.bounds.hi - mesh.bounds.lo;
  EXPECT_NEAR(size.x, 0.05, 1e-8);
  EXPECT_NEAR(size.y, 0.05, 1e-8);
  for (const vec3& p : mesh.positions) EXPECT_NEAR(mesh.frame.to_file(dvec3(p)).z, 3948996.05, 1e-8);
}

}  // namespace
}  // namespace nook
