#include "app/ssao_render.hpp"
#include "app/loading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "app/picture_scene.hpp"
#include "app/scene_options.hpp"
#include "app/ssao_draw.hpp"
#include "base/libraries.hpp"
#include "base/threads.hpp"
#include "film/exr.hpp"
#include "film/png.hpp"
#include "mesh/mesh_analysis.hpp"
#include "render/picture.hpp"
#include "scene/scene_writer.hpp"

namespace nook {

bool is_ssao_alone(const Scene& scene) {
  return std::all_of(scene.effects.begin(), scene.effects.end(),
                     [](const Effect& e) { return e.kind == EffectKind::ssao; });
}

int render_ssao(const Scene& scene, const SsaoRun& run, std::optional<TriangleMesh>& loaded) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const Clock::time_point start = Clock::now();
  RunRecord record;
  record.scene_file = run.scene_file.string();
  limit_own_threads(run.threads);
  // llvmpipe has no other way; it reads this when the context is made.
  if (run.threads > 0) setenv("LP_NUM_THREADS", std::to_string(run.threads).c_str(), 1);
  if (!loaded) loaded = load_and_warn(scene, needed_attributes(scene, run.aovs.normal));
  const TriangleMesh& mesh = *loaded;
  record.seconds.load = seconds_since(start);
  record.plan = make_plan(scene, mesh);
  record.triangles = mesh.triangles.size();
  record.scene_hash = scene_hash(scene);
  record.mesh_hash = mesh_hash(mesh);
  check_mesh(scene, run.made_of, record.mesh_hash);
  record_scene(scene, run.aov_names, run.output, record);

  const Clock::time_point drawing = Clock::now();
  Image image;
  draw_ssao(scene, mesh, run.aovs, run.frames, record, image);
  record.seconds.render = seconds_since(drawing);
  if (!run.quiet) announce_ssao(record);

  const Clock::time_point writing = Clock::now();
  image.metadata = record.metadata();
  place_crop(image, record.plan);
  write_exr(run.output, image);
  if (run.png) write_png(std::filesystem::path(run.output).replace_extension(".png"), image);
  record.seconds.write = seconds_since(writing);
  record.seconds.total = seconds_since(start);
  record.libraries = mapped_libraries();
  if (!run.stats.empty()) write_stats(run.stats, record);
  if (!run.quiet)
    fmt::print(stderr, "{}: load {:.2f} s, render {:.2f} s, write {:.2f} s\n", run.output.string(),
               record.seconds.load, record.seconds.render, record.seconds.write);
  return 0;
}

}  // namespace nook
