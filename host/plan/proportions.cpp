#include "plan/proportions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "plan/coarse_survey.hpp"
#include "plan/plan.hpp"
#include "plan/scene_camera.hpp"
#include "scene/layer_names.hpp"

namespace nook {
namespace {

struct Finding {
  CoarsestFor worst;
  std::string what;  // the distance of interest, for people

  void add(const CoarsestFor& other, const std::string& of_interest) {
    if (other.triangle && other.excess() > worst.excess()) worst = other, what = of_interest;
  }
};

std::string limit_name(const Scene& scene, std::size_t effect) {
  const Effect& e = scene.effects[effect];
  return fmt::format("the {} of {}", e.kind == EffectKind::ssao ? "radius" : "max_distance",
                     effect_label(e.kind, layer_prefixes(scene)[effect]));
}

// The triangle that is coarsest for an effect's distance limit or radius.
CoarsestFor coarsest_for(const Scene& scene, const TriangleMesh& mesh, const CoarseSurvey& survey,
                         const Effect& effect) {
  CoarsestFor worst;
  const float radius = subject_radius(mesh);
  if (is_traced(effect.kind)) {
    const double limit =
        mesh.frame.from_file(double(resolve_distance(effect, radius, scene.compat_tinyrender)));
    if (limit > 0 && std::isfinite(limit))
      worst.add(survey.coarsest.front(), survey.coarsest.front().resolution, limit);
  } else if (effect.kind == EffectKind::ssao) {
    const double reach =
        mesh.frame.from_file(effect.ssao.radius > 0 ? double(effect.ssao.radius) : 0.5 * double(radius));
    worst.add(*survey.largest, edge_resolution * survey.largest->extent, reach);
  }
  return worst;
}

void compare_limits(const Scene& scene, const TriangleMesh& mesh, const CoarseSurvey& survey,
                    Finding& finding) {
  std::size_t worst = scene.effects.size();
  for (std::size_t e = 0; e < scene.effects.size(); ++e) {
    const CoarsestFor of_effect = coarsest_for(scene, mesh, survey, scene.effects[e]);
    if (of_effect.excess() > finding.worst.excess()) finding.worst = of_effect, worst = e;
  }
  if (worst < scene.effects.size()) finding.what = limit_name(scene, worst);
}

std::string name_of(const Scene& scene, const TriangleMesh& mesh, const CoarseTriangle& triangle) {
  const std::string file = (scene.instances.empty() ? scene.mesh_file : scene.file).string();
  const bool ground = !mesh.subject.empty() && triangle.number + 2 >= mesh.scene_triangles();
  return ground ? fmt::format("{}: the ground", file)
                : fmt::format("{}: triangle {}", file, triangle.number + 1);
}

std::string far_text(const std::string& name, const TriangleMesh& mesh, double times, const std::string& what,
                     double distance) {
  const dvec3& from = mesh.frame.center;
  return fmt::format(
      "{} lies {:.1e} times as far from ({:g}, {:g}, {:g}) as {} ({:g}): there floats are too coarse for it, "
      "values may be off by more than .001",
      name, times, from.x, from.y, from.z, what, mesh.frame.to_file(distance));
}

}  // namespace

std::string proportions_warning(const Scene& scene, const TriangleMesh& mesh, bool viewer) {
  if (std::all_of(scene.effects.begin(), scene.effects.end(),
                  [](const Effect& e) { return is_surface(e.kind); }))
    return "";
  std::optional<dvec3> eye;
  if (viewer) eye = mesh.frame.from_file(resolve_camera(scene, mesh).eye);
  const CoarseSurvey survey = survey_of(mesh, eye);
  if (survey.coarsest.empty()) return "";
  Finding finding;
  compare_limits(scene, mesh, survey, finding);
  finding.add(survey.from_eye, "the distance of the eye from it");
  if (2 * survey.narrow > survey.triangles) finding.add(survey.narrowest, "it is wide");
  if (mesh.instances.empty()) finding.add(coarsest_for_small(mesh, survey), "the small triangles beside it");
  if (!finding.worst.triangle) return "";
  const CoarseTriangle& triangle = *finding.worst.triangle;
  const std::string name = name_of(scene, mesh, triangle);
  const double distance = finding.worst.distance;
  if (triangle.far > 8 * triangle.extent)
    return far_text(name, mesh, triangle.far / distance, finding.what, distance);
  return fmt::format(
      "{} is {:.1e} times as large as {} ({:g}): its corners are too coarse as floats, values near it may be "
      "off by more than .001",
      name, triangle.extent / distance, finding.what, mesh.frame.to_file(distance));
}

std::string far_points_warning(const Scene& scene, const TriangleMesh& mesh,
                               std::span<const SurfacePoint> points, const std::string& name) {
  const double limit = mesh.frame.from_file(
      double(resolve_distance(scene.effects.front(), subject_radius(mesh), scene.compat_tinyrender)));
  if (!(limit > 0)) return "";
  double worst = limit;
  std::size_t farthest = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& p = points[i];
    const double resolution = resolution_of(dvec3(p.normal[0], p.normal[1], p.normal[2]), dvec3(0),
                                            glm::abs(dvec3(p.origin[0], p.origin[1], p.origin[2])));
    if (resolution > worst) worst = resolution, farthest = i;
  }
  if (farthest == points.size()) return "";
  const SurfacePoint& p = points[farthest];
  const double far = std::max({std::abs(p.origin[0]), std::abs(p.origin[1]), std::abs(p.origin[2])});
  return far_text(fmt::format("{}: point {}", name, farthest + 1), mesh, far / limit, limit_name(scene, 0),
                  limit);
}

}  // namespace nook
