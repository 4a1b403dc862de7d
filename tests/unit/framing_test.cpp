// A camera that frames its mesh: the projections of all vertices against the margins of the picture, in
// double precision from the numbers that the kernels get.
#include "plan/framing.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plan/scene_camera.hpp"
#include "plan/scene_ground.hpp"
#include "plan/scene_mesh.hpp"
#include "scene/names.hpp"
#include "scene/scene_toml.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::TemporaryFolder;

// A soup of triangles: three corners each.
TriangleMesh mesh_of(const std::vector<dvec3>& corners) {
  TemporaryFolder folder;
  std::string text;
  for (const dvec3& p : corners) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    text += fmt::format("f {} {} {}\n", i + 1, i + 2, i + 3);
  test::write_bytes(folder / "m.obj", text);
  return load_scene_mesh(scene_of_mesh(folder / "m.obj"));
}

std::vector<dvec3> box(const dvec3& lo, const dvec3& hi) {
  std::vector<dvec3> corners;
  for (int i = 0; i < 8; ++i)
    for (const int j : {i, i ^ 1, i ^ 2})
      corners.emplace_back(j & 1 ? hi.x : lo.x, j & 2 ? hi.y : lo.y, j & 4 ? hi.z : lo.z);
  return corners;
}

std::vector<dvec3> cloud(unsigned seed, const dvec3& size) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<dvec3> corners;
  for (int i = 0; i < 999; ++i)
    corners.push_back(size * dvec3(normal(random), normal(random), normal(random)));
  return corners;
}

// What the picture shows of the mesh, in shares of its width and height from its left and top edge.
struct Seen {
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL, nearest = HUGE_VAL;
};

Seen seen(const Scene& scene, const TriangleMesh& mesh) {
  const CameraParams c = camera_params(scene, mesh);
  const auto vector = [](const float(&v)[3]) { return dvec3(v[0], v[1], v[2]); };
  Seen found;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t i : triangle) {
      const dvec3 p = dvec3(mesh.positions[i]) - vector(c.eye);
      const double z = glm::dot(p, vector(c.forward));
      const double x = 0.5 + 0.5 * glm::dot(p, vector(c.right)) / (z * c.tan_half_fov_x),
                   y = 0.5 - 0.5 * glm::dot(p, vector(c.up)) / (z * c.tan_half_fov_y);
      found.left = std::min(found.left, x), found.right = std::max(found.right, x);
      found.top = std::min(found.top, y), found.bottom = std::max(found.bottom, y);
      found.nearest = std::min(found.nearest, z);
    }
  return found;
}

// In the middle both ways, up to the margins one way and not beyond them the other. `exact`: of a share.
void expect_framed(const Scene& scene, const TriangleMesh& mesh, double exact = 2e-5) {
  const Seen s = seen(scene, mesh);
  EXPECT_GT(s.nearest, 0);
  EXPECT_NEAR(s.left, 1 - s.right, exact);
  EXPECT_NEAR(s.top, 1 - s.bottom, exact);
  EXPECT_NEAR(std::min(s.left, s.top), double(scene.margin), exact);
}

TEST(Framing, LeavesTheMarginAroundBoxesFromEverySide) {
  for (const dvec3& size : {dvec3(1, 1, 1), dvec3(5, 1, 0.2), dvec3(0.1, 3, 1)})
    for (const auto& [view, angles] : view_names)
      for (const auto& [up, axis] : axis_names) {
        SCOPED_TRACE(fmt::format("{} up {}", view, up));
        Scene scene = scene_of_mesh("m.obj");
        scene.view = angles;
        scene.camera.up = vec3(direction_of(axis));
        expect_framed(scene, mesh_of(box(-size, size)));
      }
}

TEST(Framing, LeavesWhateverMarginWhateverThePictureIs) {
  const TriangleMesh mesh = mesh_of(cloud(1, dvec3(1, 3, 0.5)));
  for (const auto& [width, height] : {std::pair(640, 480), {64, 640}, {1000, 10}, {1, 1}})
    for (const float margin : {0.0f, 0.08f, 0.25f, 0.45f})
      for (const float fov : {1.0f, 30.0f, 120.0f}) {
        SCOPED_TRACE(fmt::format("{}x{}, margin {}, fov {}", width, height, margin, fov));
        Scene scene = scene_of_mesh("m.obj");
        scene.width = width, scene.height = height, scene.margin = margin, scene.camera.fov = fov;
        scene.view = {-70, 33};
        expect_framed(scene, mesh, 1e-4);
      }
}

// A quarter pixel of 768 is 3e-4: what floats of the camera leave far from 0 and of sizes near their ends.
TEST(Framing, FitsAtAnyPlaceAndSize) {
  for (const double size : {1e-18, 1e-6, 1.0, 1e6, 1e17})
    for (const double away : {0.0, 3.0, 1e3, 1e6}) {
      SCOPED_TRACE(fmt::format("size {} at {}", size, away));
      std::vector<dvec3> corners = cloud(2, dvec3(1, 0.6, 2));
      for (dvec3& p : corners) p = size * (p + away * dvec3(1, -0.3, 0.7));
      expect_framed(scene_of_mesh("m.obj"), mesh_of(corners), 3e-4);
    }
}

TEST(Framing, FitsFlatMeshesTrianglesAndNeedles) {
  const std::vector<std::vector<dvec3>> meshes = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},                                   // a triangle
      {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}},  // a horizontal square
      {{0, 0, 0}, {0, 5, 1e-6}, {1e-6, 5, 0}},                             // an upright needle
      {{-5, 0, 0}, {5, 0, 1e-7}, {5, 1e-7, 0}}};                           // one that lies
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (const View& view : {View{}, View{0, 0}, View{90, 0}, View{10, 60}}) {
      SCOPED_TRACE(fmt::format("mesh {} from {}", m, to_string(view)));
      Scene scene = scene_of_mesh("m.obj");
      scene.view = view;
      const bool end_on = m == 3 && view == View{90, 0};
      if (!end_on) expect_framed(scene, mesh_of(meshes[m]), 1e-4);
    }
}

// Seen along itself, a line or a point has no size to fill a picture with: it is in the middle, in front.
TEST(Framing, PutsALineSeenEndOnIntoTheMiddle) {
  for (const double size : {0.0, 1e-9, 1.0, 1e9}) {
    Scene scene = scene_of_mesh("m.obj");
    scene.view = {90, 0};
    const TriangleMesh mesh = mesh_of({{-size, 7, 3}, {size, 7, 3}, {0, 7, 3}});
    const Seen s = seen(scene, mesh);
    EXPECT_GT(s.nearest, 0) << size;
    EXPECT_NEAR(s.left, 0.5, 1e-3) << size;
    EXPECT_NEAR(s.bottom, 0.5, 1e-3) << size;
  }
}

// Of instances that are kept as trees the vertices are where their copies' are.
TEST(Framing, SeesInstancesInPlace) {
  TemporaryFolder folder;
  test::write_bytes(folder / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  test::write_bytes(
      folder / "s.toml",
      "[input]\nobjfile = \"m.obj\"\n[[instance]]\nobjfile = \"m.obj\"\ntranslate = [4, 0, -1]\n"
      "rotate = [0, 0, 30]\nscale = -2\n[ground]\n[camera]\nview = \"20,10\"\n");
  const Scene scene = load_scene(folder / "s.toml");
  const TriangleMesh copies = load_scene_mesh(scene, {}, Instancing::copies),
                     trees = load_scene_mesh(scene, {}, Instancing::tree);
  ASSERT_TRUE(copies.instances.empty());
  ASSERT_EQ(trees.instances.size(), 3u);
  const Camera a = framing_camera(scene, copies), b = framing_camera(scene, trees);
  EXPECT_LT(glm::length(a.eye - b.eye), 1e-6);
  EXPECT_LT(glm::length(a.at - b.at), 1e-6);
}

// Where the eye is, seen from the mesh: with y up as in a modeller, with z up as in Blender.
TEST(Framing, LooksFromTheSideThatTheViewNames) {
  const struct {
    const char* view;
    vec3 up;
    dvec3 towards;
    vec3 picture_up;
  } cases[] = {{"front", {0, 1, 0}, {0, 0, 1}, {0, 1, 0}},    {"back", {0, 1, 0}, {0, 0, -1}, {0, 1, 0}},
               {"right", {0, 1, 0}, {1, 0, 0}, {0, 1, 0}},    {"left", {0, 1, 0}, {-1, 0, 0}, {0, 1, 0}},
               {"top", {0, 1, 0}, {0, 1, 0}, {0, 0, -1}},     {"bottom", {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
               {"front", {0, 0, 1}, {0, -1, 0}, {0, 0, 1}},   {"right", {0, 0, 1}, {1, 0, 0}, {0, 0, 1}},
               {"top", {0, 0, 1}, {0, 0, 1}, {0, 1, 0}},      {"front", {1, 0, 0}, {0, 0, 1}, {1, 0, 0}},
               {"right", {1, 0, 0}, {0, -1, 0}, {1, 0, 0}},   {"front", {0, -1, 0}, {0, 0, 1}, {0, -1, 0}},
               {"right", {0, -1, 0}, {-1, 0, 0}, {0, -1, 0}}, {"front", {0, 0, -1}, {0, 1, 0}, {0, 0, -1}},
               {"90,0", {0, 1, 0}, {1, 0, 0}, {0, 1, 0}},     {"0,90", {0, 1, 0}, {0, 1, 0}, {0, 0, -1}}};
  const TriangleMesh mesh = mesh_of(box(dvec3(-1), dvec3(1)));
  for (const auto& c : cases) {
    SCOPED_TRACE(fmt::format("{} up {} {} {}", c.view, c.up.x, c.up.y, c.up.z));
    Scene scene = scene_of_mesh("m.obj");
    scene.view = *parse_view(c.view);
    scene.camera.up = c.up;
    const Camera camera = framing_camera(scene, mesh);
    EXPECT_LT(glm::length(glm::normalize(camera.eye - camera.at) - c.towards), 1e-9);
    EXPECT_LT(glm::length(camera.up - c.picture_up), 1e-6f);
    EXPECT_LT(glm::length(camera.at), 1e-6);  // the middle of a box that is seen straight on
  }
  // Three-quarter: from the front, the right and above.
  const Camera camera = framing_camera(scene_of_mesh("m.obj"), mesh);
  const dvec3 from = camera.eye - camera.at;
  EXPECT_GT(from.z, from.x);
  EXPECT_GT(from.x, 0);
  EXPECT_GT(from.y, 0);
}

// Each vertex sweeps a circle: no picture lets it out, and of many pictures one comes up to a margin.
TEST(Framing, KeepsATurnWithinTheMarginsAtOneDistance) {
  for (const auto& [up, elevation] :
       {std::pair(vec3(0, 1, 0), 25.0), {vec3(0, 0, 1), 0.0}, {vec3(0, 1, 0), -50.0}}) {
    Scene scene = scene_of_mesh("m.obj");
    scene.camera.up = up;
    scene.view = {30, elevation};
    scene.width = 300, scene.height = 400;
    const TriangleMesh mesh = mesh_of(cloud(3, dvec3(4, 0.5, 1)));
    const std::vector<Camera> cameras = framing_turn(scene, mesh, 90);
    ASSERT_EQ(cameras.size(), 90u);
    double least = 1;
    for (const Camera& camera : cameras) {
      Scene turned = scene;
      turned.automatic_camera = false;
      turned.camera = camera;
      const Seen s = seen(turned, mesh);
      EXPECT_GT(s.nearest, 0);
      least = std::min({least, s.left, 1 - s.right, s.top, 1 - s.bottom});
      EXPECT_NEAR(glm::length(camera.eye - camera.at), glm::length(cameras[0].eye - cameras[0].at), 1e-9);
    }
    EXPECT_GE(least, 0.08 - 1e-5);
    EXPECT_LT(least, 0.08 + 2e-3);
  }
}

// The ground is below the mesh, and no ray of the picture that goes down leaves it.
TEST(Framing, PutsAGroundUnderAllThatThePictureShows) {
  const std::vector<dvec3> corners = box(dvec3(-1, 2, 3), dvec3(1, 4, 5));
  for (const auto& [up, axis] : axis_names)
    for (const View& view : {View{}, View{-100, 40}, View{0, 90}}) {
      SCOPED_TRACE(fmt::format("up {} from {}", up, to_string(view)));
      Scene scene = picture_of_mesh("m.obj");
      scene.camera.up = vec3(direction_of(axis));
      scene.view = view;
      TriangleMesh mesh = mesh_of(corners);
      const int a = number_of(axis);
      const float lowest = is_opposite(axis) ? mesh.bounds.hi[a] : mesh.bounds.lo[a];
      const CameraParams before = camera_params(scene, mesh);
      add_ground(scene, mesh);
      ASSERT_FALSE(mesh.subject.empty()) << mesh.why_no_ground;
      EXPECT_EQ(mesh.ground.up, axis);
      EXPECT_EQ(mesh.ground.height, lowest);
      const CameraParams c = camera_params(scene, mesh);  // the ground is not framed
      for (int i = 0; i < 3; ++i) EXPECT_EQ(c.eye[i], before.eye[i]);
      const dvec3 center(mesh.subject.center());
      for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
          dvec3 eye, ray;
          for (int i = 0; i < 3; ++i) {
            eye[i] = c.eye[i];
            ray[i] = c.forward[i] + x * c.tan_half_fov_x * c.right[i] + y * c.tan_half_fov_y * c.up[i];
          }
          const double t = (lowest - eye[a]) / ray[a];
          ASSERT_GT(t, 0);
          const dvec3 met = eye + t * ray - center;
          EXPECT_LT(std::abs(met[(a + 1) % 3]), mesh.ground.reach);
          EXPECT_LT(std::abs(met[(a + 2) % 3]), mesh.ground.reach);
        }
      }
      // Its normal is the up axis.
      const auto& t = mesh.triangles.back();
      const dvec3 p(mesh.positions[t[0]]), q(mesh.positions[t[1]]), r(mesh.positions[t[2]]);
      EXPECT_LT(glm::length(glm::normalize(glm::cross(q - p, r - p)) - direction_of(axis)), 1e-6);
      // Settled, it is the same for whatever camera.
      Scene settled = scene;
      settled.automatic_camera = false;
      settled.ground = settled_ground(mesh);
      TriangleMesh again = mesh_of(corners);
      add_ground(settled, again);
      EXPECT_EQ(again.positions, mesh.positions);
    }
}

TEST(Framing, LeavesAGroundOutThatWouldHideTheMeshOrFightWithIt) {
  TriangleMesh above = mesh_of(box(dvec3(-1), dvec3(1))), flat = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
  Scene scene = picture_of_mesh("m.obj");
  add_ground(scene, flat);
  EXPECT_EQ(flat.why_no_ground, "the mesh lies flat on it");
  EXPECT_TRUE(flat.subject.empty());
  scene.view = {0, -90};
  add_ground(scene, above);
  EXPECT_EQ(above.why_no_ground, "the camera is not above it");
  EXPECT_TRUE(above.subject.empty());
}

TEST(ViewNames, AreReadAndWritten) {
  for (const auto& [name, view] : view_names) {
    EXPECT_EQ(parse_view(name), view);
    EXPECT_EQ(to_string(view), name);
  }
  EXPECT_EQ(to_string(*parse_view("12.5,-3")), "12.5,-3");
  EXPECT_EQ(parse_view("+30,25"), View());
  for (const char* bad :
       {"", "sideways", "30", "30,", ",25", "30,25,1", "30;25", "nan,0", "0,90.1", "400,0", "30, 25"})
    EXPECT_FALSE(parse_view(bad)) << bad;
}

TEST(BackgroundNames, AreReadAndWritten) {
  for (const auto& [name, background] : background_names) {
    EXPECT_EQ(parse_background(name), background);
    EXPECT_EQ(to_string(background), name);
  }
  EXPECT_EQ(parse_background("#0fA001"), (Background{false, 15, 160, 1}));
  EXPECT_EQ(to_string(Background{false, 15, 160, 1}), "#0fa001");
  for (const char* bad : {"", "#", "#fff", "#0000000", "#00000g", "#-00001", "#+00001", "pink"})
    EXPECT_FALSE(parse_background(bad)) << bad;
}

TEST(PointNames, AreAxesOrThreeNumbers) {
  EXPECT_EQ(parse_point("-z"), dvec3(0, 0, -1));
  EXPECT_EQ(parse_point("1,-2.5,3e2"), dvec3(1, -2.5, 300));
  for (const char* bad : {"", "w", "--z", "1,2", "1,2,3,4", "1,2,inf", "1,,2", "1,2,1e39"})
    EXPECT_FALSE(parse_point(bad)) << bad;
}

}  // namespace
}  // namespace nook
