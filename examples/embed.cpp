// A triangle mesh in two arrays, made into a picture of its ambient occlusion: what a program of yours needs
// of nook.
//
//   find_package(nook REQUIRED)
//   add_executable(embed embed.cpp)
//   target_link_libraries(embed PRIVATE nook::nook)
#include <cstdio>
#include <exception>
#include <vector>

#include "device/device.hpp"
#include "image/exr.hpp"
#include "image/png.hpp"
#include "mesh/mesh_of_arrays.hpp"
#include "render/scene_renderer.hpp"
#include "scene/scene_toml.hpp"

namespace {

// Says how far the picture is; it could also end it (cancelled()).
class Percent : public nook::RunObserver {
  void progress(const nook::RunProgress& now) override {
    std::fprintf(stderr, "\r%3.0f %%", 100.0 * double(now.samples) / double(now.total));
  }
  void end() override { std::fputc('\n', stderr); }
};

}  // namespace

int main() try {
  // A floor and a pyramid on it.
  const std::vector<float> positions = {-3, 0, -3, 3,  0, -3, 3, 0,  3, -3, 0, 3,    -1, 0,
                                        -1, 1, 0,  -1, 1, 0,  1, -1, 0, 1,  0, 1.5f, 0};
  const std::vector<std::uint32_t> triangles = {0, 3, 2, 0, 2, 1, 4, 8, 5, 5, 8, 6, 6, 8, 7, 7, 8, 4};

  nook::Scene scene = nook::scene_of_mesh("pyramid");  // a camera that frames it, one effect: AO
  scene.width = 320;
  scene.height = 240;
  scene.spp = 64;
  nook::SceneRenderer renderer(scene, nook::mesh_of_arrays(positions, triangles),
                               [] { return nook::Device(nook::select_device("")); });
  Percent percent;
  const nook::Image picture = renderer.render(&percent);
  nook::write_exr("pyramid.exr", picture);
  nook::write_png("pyramid.png", picture);
  std::printf("pyramid.exr, pyramid.png: %dx%d pixels on %s\n", picture.width, picture.height,
              renderer.device().info().name.c_str());
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
