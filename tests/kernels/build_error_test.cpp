// A kernel that does not build says where: in the author's file, by its own line.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "device/kernel_source.hpp"
#include "support/kernels.hpp"
#include "support/mutants.hpp"

namespace nook::test {
namespace {

TEST(BuildError, NamesTheKernelsFileAndLine) {
  const std::string source = kernel_source("stage/occlusion.cl");
  const std::string warp = "float3 square_to_cosine_hemisphere(float2 u) {";
  const std::string broken = mutate(source, warp, warp + " return undeclared;");
  // The line that the mutant is in, counted in its own file: after the last #line marker.
  const std::string before = source.substr(0, source.find(warp));
  const std::size_t marker = before.rfind("#line ");
  ASSERT_NE(marker, std::string::npos);
  const int first = std::stoi(before.substr(marker + 6));
  const auto line =
      first + std::count(before.begin() + std::ptrdiff_t(before.find('\n', marker)) + 1, before.end(), '\n');
  try {
    build_program(device(), broken, BuildOptions());
    ADD_FAILURE() << "it builds";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.kind(), ErrorKind::device);
    EXPECT_NE(message.find("kernels/sample/warp.cl:" + std::to_string(line)), std::string::npos) << message;
    EXPECT_NE(message.find("undeclared"), std::string::npos) << message;
    EXPECT_NE(message.find("CL_BUILD_PROGRAM_FAILURE"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace nook::test
