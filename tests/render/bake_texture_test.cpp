// Baking into a texture is estimating at the texels' points: what nook probe does. Which texels those are,
// and that a filter reads no background at a seam.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <stdexcept>

#include "mesh/obj_loader.hpp"
#include "points/texture_points.hpp"
#include "support/expect_error.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

// A floor and a wall beside it, each a chart of its own; normals along the axes, so that writing them as text
// keeps their bits.
constexpr const char* corner_obj = R"(v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v -1 1.5 -1
v 1 1.5 -1
vt 0.05 0.05
vt 0.45 0.05
vt 0.45 0.45
vt 0.05 0.45
vt 0.55 0.05
vt 0.95 0.05
vt 0.95 0.85
vt 0.55 0.85
f 1/4 4/1 3/2 2/3
f 1/5 2/6 6/7 5/8
)";

// A cube of six charts with gaps between them. Nothing occludes its outside: AO is 1.
std::string cube_obj() {
  std::ostringstream obj;
  for (int i = 0; i < 8; ++i) obj << "v " << (i & 1) << ' ' << (i >> 1 & 1) << ' ' << (i >> 2 & 1) << '\n';
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int f = 0; f < 6; ++f) {
    // Turned a little, so that edges cut texels at every angle.
    const double x = 0.17 + 0.33 * (f % 3), y = 0.25 + 0.5 * (f / 3);
    for (int k = 0; k < 4; ++k) {
      const double angle = 0.3 + f + 1.5707963267948966 * k;
      obj << "vt " << x + 0.13 * std::cos(angle) << ' ' << y + 0.13 * std::sin(angle) << '\n';
    }
    obj << 'f';
    for (int k = 0; k < 4; ++k) obj << ' ' << faces[f][k] + 1 << '/' << 4 * f + k + 1;
    obj << '\n';
  }
  return obj.str();
}

std::filesystem::path write_scene(const TemporaryFolder& folder, const std::string& obj,
                                  const std::string& rest) {
  write_bytes(folder / "mesh.obj", obj);
  write_bytes(folder / "scene.toml", "[input]\nobjfile = \"mesh.obj\"\n[renderer]\n" + rest);
  return folder / "scene.toml";
}

Image bake(const TemporaryFolder& folder, const std::filesystem::path& scene, const std::string& arguments) {
  const ProgramResult run = run_nook(folder, "bake '" + scene.string() + "' --to texture -o '" +
                                                 (folder / "baked.exr").string() + "' " + arguments);
  // What a test would read of no picture is not there: it ends here, as a failure.
  if (run.code != 0) throw std::runtime_error("nook bake: " + run.err);
  return read_exr(folder / "baked.exr");
}

TriangleMesh mesh_of(const TemporaryFolder& folder, const std::string& obj) {
  write_bytes(folder / "mesh.obj", obj);
  return load_obj(folder / "mesh.obj", {.normals = true, .uvs = true});
}

// The texel's value as a bilinear filter reads it at (u, v).
float bilinear(const std::vector<float>& values, int size, double u, double v) {
  const double x = u * size - 0.5, y = (1 - v) * size - 0.5;
  const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
  double sum = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const int cx = x0 + (corner & 1), cy = y0 + (corner >> 1);
    const double weight = (corner & 1 ? x - x0 : 1 - (x - x0)) * (corner >> 1 ? y - y0 : 1 - (y - y0));
    sum += weight * values[std::size_t(std::clamp(cy, 0, size - 1) * size + std::clamp(cx, 0, size - 1))];
  }
  return float(sum);
}

TEST(BakeTexture, TexelsAreProbesToTheBit) {
  const TemporaryFolder folder;
  const auto scene = write_scene(folder, corner_obj, "max_distance = 1.0\n");
  const Image image =
      bake(folder, scene, "--size 24 --dilation 0 --spp 16 --directions 4 --aov position,normal");
  ASSERT_EQ(image.width, 24);
  const auto ao = plane(image, "R"), covered = plane(image, "A");
  std::ostringstream csv;
  csv.precision(9);
  std::vector<float> baked;
  for (std::size_t i = 0; i < ao.size(); ++i) {
    if (covered[i] == 0) continue;
    baked.push_back(ao[i]);
    for (const char* channel : {"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"})
      csv << plane(image, channel)[i] << (channel == std::string("N.Z") ? '\n' : ',');
  }
  ASSERT_GT(baked.size(), 200u);
  write_bytes(folder / "points.csv", csv.str());
  const ProgramResult probed = run_nook(folder, "probe '" + scene.string() + "' --samples 64 --points '" +
                                                    (folder / "points.csv").string() + "'");
  ASSERT_EQ(probed.code, 0) << probed.err;
  std::istringstream rows(probed.out);
  std::string line;
  std::getline(rows, line);
  int partly = 0;
  for (const float value : baked) {
    ASSERT_TRUE(std::getline(rows, line));
    EXPECT_EQ(value, std::stof(line));
    partly += value > 0.1f && value < 0.9f;
  }
  EXPECT_GT(partly, 20);
}

// v = 1 is the top row: the wall's chart reaches up to v = 0.85, where the wall is 1.5 high.
TEST(BakeTexture, RowsGoDownFromTheTop) {
  const TemporaryFolder folder;
  const TexturePoints points = texture_points(mesh_of(folder, corner_obj), 100);
  const auto at = [&](std::uint32_t x, std::uint32_t y) {
    const auto found = std::find(points.texels.begin(), points.texels.end(), y * 100 + x);
    return found == points.texels.end() ? vec3(9)
                                        : points.positions[std::size_t(found - points.texels.begin())];
  };
  EXPECT_NEAR(at(75, 15).y, 1.5 * (0.845 - 0.05) / 0.8, 1e-5);
  EXPECT_NEAR(at(75, 94).y, 1.5 * (0.055 - 0.05) / 0.8, 1e-5);
  EXPECT_EQ(at(75, 10), vec3(9));
  EXPECT_EQ(points.overlapping, 0u);
}

// Conservative: whichever point of a triangle is taken, the texel it falls into is covered; and it lies on
// the triangle.
TEST(BakeTexture, EveryTexelThatATriangleTouchesIsCovered) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = mesh_of(folder, cube_obj());
  const int size = 37;
  const TexturePoints points = texture_points(mesh, size);
  std::vector<bool> covered(std::size_t(size * size));
  for (const std::uint32_t texel : points.texels) covered[texel] = true;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const std::size_t t = random() % mesh.triangles.size();
    double a = uniform(random), b = uniform(random);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const auto& c = mesh.triangle_uvs[t];
    const glm::dvec2 uv = (1 - a - b) * glm::dvec2(mesh.uvs[c[0]]) + a * glm::dvec2(mesh.uvs[c[1]]) +
                          b * glm::dvec2(mesh.uvs[c[2]]);
    EXPECT_TRUE(covered[std::size_t(int((1 - uv.y) * size) * size + int(uv.x * size))])
        << uv.x << ' ' << uv.y;
  }
  for (const vec3& p : points.positions) {
    const double out = std::max({std::abs(p.x - 0.5), std::abs(p.y - 0.5), std::abs(p.z - 0.5)});
    EXPECT_NEAR(out, 0.5, 1e-6);
  }
}

// Every point of the cube reads 1 through a bilinear filter; without dilation the background darkens its
// seams.
TEST(BakeTexture, NoFilterReadsTheBackgroundAtASeam) {
  const TemporaryFolder folder;
  const auto scene = write_scene(folder, cube_obj(), "max_distance = \"none\"\n");
  const TriangleMesh mesh = mesh_of(folder, cube_obj());
  const auto darkest = [&](const std::string& dilation) {
    const auto ao = plane(bake(folder, scene, "--size 48 --spp 8 --dilation " + dilation), "R");
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    float least = 2;
    for (int i = 0; i < 20000; ++i) {
      const auto& c = mesh.triangle_uvs[random() % mesh.triangles.size()];
      double a = uniform(random), b = uniform(random);
      if (i % 2) b = 1 - a;  // on an edge
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const vec2 uv =
          float(1 - a - b) * mesh.uvs[c[0]] + float(a) * mesh.uvs[c[1]] + float(b) * mesh.uvs[c[2]];
      least = std::min(least, bilinear(ao, 48, uv.x, uv.y));
    }
    return least;
  };
  EXPECT_NEAR(darkest("2"), 1, 1e-6);
  EXPECT_LT(darkest("0"), 0.9f);
}

TEST(BakeTexture, DilationTakesTheNearest) {
  // Covered: (1,1) and (5,1) of 8 x 8.
  const std::vector<std::uint32_t> source = dilation_sources({9, 13}, 8, 3);
  EXPECT_EQ(source[9], 9u);
  EXPECT_EQ(source[10], 9u);
  EXPECT_EQ(source[12], 13u);
  EXPECT_EQ(source[11], 9u);  // equally near: the first
  EXPECT_EQ(source[4 * 8 + 1], 9u);
  EXPECT_EQ(source[5 * 8 + 1], no_texel);
}

TEST(BakeTexture, BentNormalsStayUnit) {
  const TemporaryFolder folder;
  const auto scene = write_scene(folder, corner_obj, "type = \"bent\"\n");
  const Image image = bake(folder, scene, "--size 16 --spp 64");
  const auto x = plane(image, "bent.X"), y = plane(image, "bent.Y"), z = plane(image, "bent.Z"),
             a = plane(image, "A");
  int beyond = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const float length = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    if (length == 0) continue;
    EXPECT_NEAR(length, 1, 1e-5);
    beyond += a[i] == 0;
  }
  EXPECT_GT(beyond, 20);
}

TEST(BakeTexture, OverlapsAreCountedOnce) {
  const TemporaryFolder folder;
  // The same chart twice: the texels whose centres lie within it, not those on its edges.
  const std::string twice = std::string(corner_obj) + "v 0 9 0\nv 1 9 0\nv 0 9 1\nf 7/1 8/2 9/3\n";
  const TexturePoints points = texture_points(mesh_of(folder, twice), 40);
  EXPECT_GT(points.overlapping, 80u);
  EXPECT_LT(points.overlapping, 140u);  // half of 16 x 16 texels
}

TEST(BakeTexture, RefusesMeshesWithoutACompleteMap) {
  const TemporaryFolder folder;
  TriangleMesh mesh = mesh_of(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_error(ErrorKind::scene, "no triangle has texture coordinates", [&] { texture_points(mesh, 8); });
  mesh = mesh_of(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  expect_error(ErrorKind::scene, "(2, 0) of triangle 1 lie outside 0 to 1", [&] { texture_points(mesh, 8); });
}

}  // namespace
}  // namespace nook::test
