#include "support/rendering.hpp"

#include <algorithm>

#include "points/outside.hpp"
#include "render/point_estimates.hpp"

namespace nook::test {

Renderer::Renderer(const Scene& scene, const TriangleMesh& mesh, const OcclusionTracer::KernelSource& source,
                   Traversal traversal)
    : mesh_(mesh),
      plan_(make_plan(scene, mesh)),
      bvh_(build_bvh(mesh)),
      tracer_(device(), plan_, mesh_, bvh_, source, traversal) {}

std::vector<Film> Renderer::films() {
  std::vector<Film> films = tracer_.make_films();
  tracer_.accumulate(pixels_in_order(plan_.window, plan_.width), {0, plan_.samples_per_pixel()}, films);
  return films;
}

ReferenceImage Renderer::picture() {
  const Film film = std::move(films().front());
  ReferenceImage image{film.width, film.height, double(plan_.spp), {}, {}};
  for (std::size_t i = 0; i < film.pixels(); ++i) {
    image.mean.push_back(film.value(i));
    image.variance.push_back(film.variance(i));
  }
  return image;
}

Film Renderer::at_points(std::vector<SurfacePoint> points, std::uint32_t directions) {
  move_outside(points, mesh_);
  return tracer_.estimate_points(points, 0, directions);
}

Film Renderer::with_errors(std::vector<SurfacePoint> points, std::uint32_t directions) {
  move_outside(points, mesh_);
  return std::move(estimate_at_points(tracer_, plan_, points, directions)[0]);
}

ReferenceImage replicated_picture(Scene scene, const TriangleMesh& mesh, int replicates) {
  ReferenceImage total{scene.width, scene.height, double(replicates), {}, {}};
  total.mean.resize(std::size_t(scene.width) * std::size_t(scene.height));
  total.variance.resize(total.mean.size());
  std::vector<double> squares(total.mean.size());
  for (int k = 0; k < replicates; ++k) {
    ++scene.seed;
    ReferenceImage one = Renderer(scene, mesh).picture();
    for (std::size_t i = 0; i < squares.size(); ++i) {
      total.mean[i] += one.mean[i] / replicates;
      squares[i] += one.mean[i] * one.mean[i] / replicates;
    }
  }
  for (std::size_t i = 0; i < squares.size(); ++i)
    total.variance[i] = std::max(0.0, squares[i] - total.mean[i] * total.mean[i]) / (replicates - 1);
  return total;
}

}  // namespace nook::test
