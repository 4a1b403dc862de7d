// What plain AO does not ask for is not in its machine code: whatever is written there, the code is the same
// to the byte.
#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "device/kernel_source.hpp"
#include "support/kernels.hpp"
#include "support/mutants.hpp"

namespace nook::test {
namespace {

std::string binary_of(const BuiltProgram& program) {
  std::size_t size = 0;
  const auto get = opencl().clGetProgramInfo;
  check_opencl(get(program.program.get(), CL_PROGRAM_BINARY_SIZES, sizeof size, &size, nullptr), "sizes");
  std::string binary(size, '\0');
  char* to = binary.data();
  check_opencl(get(program.program.get(), CL_PROGRAM_BINARIES, sizeof to, &to, nullptr), "binaries");
  return binary;
}

// The kernel's machine code: the ELF file in PoCL's binary, which also holds bit code of all functions that
// the program has. Empty where the binary is of another kind.
std::string machine_code(const std::string& source, const BuildOptions& options) {
  // A source of its own: what PoCL knows of the product's may be code for one size of work-group.
  const std::string binary =
      binary_of(build_program(device(), "typedef int of_this_test;\n" + source, options));
  const std::size_t begin = binary.find(
      "\x7f"
      "ELF");
  if (begin == std::string::npos || binary.size() - begin < sizeof(Elf64_Ehdr)) return "";
  Elf64_Ehdr header;
  std::memcpy(&header, binary.data() + begin, sizeof header);
  // The sections' headers stand at its end.
  return binary.substr(begin, header.e_shoff + std::size_t(header.e_shentsize) * header.e_shnum);
}

BuildOptions plain(const std::string& file) {
  BuildOptions options;
  options.define("SAMPLER", 3);
  if (file == "stage/primary.cl") return options.define("VERTEX_NORMALS", 0);
  return options.define("EFFECT", 0).define("SAMPLING", 0).define("REPLICATE_DIRECTIONS", 0);
}

// Of the product's plain kernel; compiled once.
const std::string& plain_code(const char* file) {
  static std::map<std::string, std::string> codes;
  const auto [place, fresh] = codes.try_emplace(file);
  if (fresh) place->second = machine_code(kernel_source(file), plain(file));
  return place->second;
}

struct Part {
  const char* what;
  const char* file;
  const char* find;     // in the part's code
  const char* replace;  // different code of as many lines
  std::vector<std::pair<const char*, long>> on;
};

class PlainKernel : public ::testing::TestWithParam<Part> {};

TEST_P(PlainKernel, HoldsNothingOfWhatIsOff) {
  const Part& part = GetParam();
  const std::string source = kernel_source(part.file), other = mutate(source, part.find, part.replace);
  const std::string& code = plain_code(part.file);
  if (code.empty()) GTEST_SKIP() << "the device's binaries hold no ELF file";
  ASSERT_GT(code.size(), 1000u);
  EXPECT_TRUE(code == machine_code(other, plain(part.file)));
  BuildOptions on;
  on.define("SAMPLER", 3);
  for (const auto& [macro, value] : part.on) on.define(macro, value);
  EXPECT_FALSE(machine_code(source, on) == machine_code(other, on)) << "the change changes nothing";
}

INSTANTIATE_TEST_SUITE_P(
    Effects, PlainKernel,
    ::testing::Values(
        Part{"falloff",
             "stage/occlusion.cl",
             "return s * s * (3.0f - 2.0f * s);",
             "return s * s * (3.5f - 2.5f * s);",
             {{"FALLOFF", 2}}},
        Part{"min_distance",
             "stage/occlusion.cl",
             "origins->x[k] += p->min_distance * d->x[k];",
             "origins->x[k] -= p->min_distance * d->x[k];",
             {{"MIN_DISTANCE", 1}}},
        Part{"cone", "stage/occlusion.cl", "y = sine * in_frame.y;", "y = sine * in_frame.x;", {{"CONE", 1}}},
        Part{"side",
             "stage/occlusion.cl",
             "-2.0f * point->distance",
             "-3.0f * point->distance",
             {{"SIDE", 1}}},
        Part{"bent", "stage/occlusion.cl", "weight * d.x", "weight * d.y", {{"BENT", 1}}},
        Part{"bent_view",
             "stage/occlusion.cl",
             "-dot(d, forward)",
             "dot(d, forward)",
             {{"BENT", 1}, {"BENT_VIEW", 1}}},
        Part{"receivers", "stage/occlusion.cl", "(stored & 31u)", "(stored & 30u)", {{"RECEIVERS", 1}}},
        Part{"occluders_self",
             "stage/occlusion.cl",
             "first_of_group[2 * g + 1]",
             "first_of_group[2 * g]",
             {{"ONLY_SELF", 1}}},
        Part{"cut_outs", "stage/occlusion.cl", "< 127.5f", "< 126.5f", {{"CUT_OUTS", 1}}},
        Part{"instances",
             "stage/occlusion.cl",
             "LOAD_NODE(planes + BVH_WIDTH + y)",
             "LOAD_NODE(planes + 2u * BVH_WIDTH + y)",
             {{"INSTANCES", 1}}},
        Part{"reach",
             "stage/occlusion.cl",
             "#define REACH_VISITS 12u",
             "#define REACH_VISITS 11u",
             {{"REACH", 1}}},
        Part{"reflection",
             "stage/occlusion.cl",
             "2.0f * cosine_between(n, v)",
             "1.5f * cosine_between(n, v)",
             {{"EFFECT", 1}, {"SAMPLING", 3}}},
        Part{"exponent_of_material",
             "stage/occlusion.cl",
             "? -1.0f : exponents[point->material]",
             "? -1.0f : exponents[0]",
             {{"EFFECT", 1}, {"SAMPLING", 3}, {"EXPONENT_OF_MATERIAL", 1}}},
        Part{"one_ray_at_a_time",
             "stage/occlusion.cl",
             "stack[size++] = BVH_ITEM(node, lane);",
             "stack[size++] = BVH_ITEM(node, 0);",
             {{"TRAVERSAL_SCALAR", 1}}},
        Part{"vertex_normals",
             "stage/primary.cl",
             "length2 > 1e-12f",
             "length2 > 1e-11f",
             {{"VERTEX_NORMALS", 1}}},
        Part{"materials",
             "stage/primary.cl",
             "triangle_materials[STORED(triangle[k])]",
             "triangle_materials[STORED(triangle[k]) + 1u]",
             {{"MATERIALS", 1}}},
        Part{"cut_outs_seen", "stage/primary.cl", "< 127.5f", "< 126.5f", {{"CUT_OUTS", 1}}},
        Part{"instances_seen",
             "stage/primary.cl",
             "mesh->first_triangle - mesh->mesh_triangle",
             "mesh->first_triangle + mesh->mesh_triangle",
             {{"INSTANCES", 1}}}),
    [](const auto& part) { return std::string(part.param.what); });

}  // namespace
}  // namespace nook::test
