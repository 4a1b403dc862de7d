#include "plan/framing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "plan/subject_points.hpp"

namespace nook {
namespace {

constexpr double degrees = std::numbers::pi / 180;

// The axes of a picture: to its right, up in it, and from the mesh to the eye.
struct Axes {
  dvec3 right, up, back;
};

Axes axes_of(const Sides& sides, double azimuth, double elevation) {
  const double ca = std::cos(azimuth * degrees), sa = std::sin(azimuth * degrees),
               ce = std::cos(elevation * degrees), se = std::sin(elevation * degrees);
  const dvec3 across = ca * sides.front + sa * sides.right;
  return {ca * sides.right - sa * sides.front, ce * sides.up - se * across, ce * across + se * sides.up};
}

// Tangents of the angles from the middle of the picture to its margins.
struct Tangents {
  double x, y;
};

Tangents tangents_of(const Scene& scene) {
  const double half = std::tan(scene.camera.fov * std::numbers::pi / 360) * (1 - 2 * double(scene.margin));
  return {half * scene.width / scene.height, half};
}

dvec3 middle_of(const TriangleMesh& mesh) {
  const Bounds3& b = mesh.subject_bounds();
  return 0.5 * (dvec3(b.lo) + dvec3(b.hi));
}

// At least so far before the mesh that the eye is another float than what it looks at.
double least_depth(const TriangleMesh& mesh) {
  return std::max(
      {1e-30, 1e-4 * glm::length(middle_of(mesh)), 1e-4 * mesh.subject_bounds().bounding_radius()});
}

Camera camera_at(const Scene& scene, const TriangleMesh& mesh, const Axes& axes, const dvec3& eye,
                 double depth) {
  Camera camera;
  camera.fov = scene.camera.fov;
  camera.up = vec3(axes.up);
  camera.eye = mesh.frame.to_file(eye);
  camera.at = mesh.frame.to_file(eye - depth * axes.back);
  return camera;
}

// The two planes of a frustum that hold all points p on one side each, |x| <= z tangent, in one of the
// picture's directions `side`. With the eye e at depth d = dot(e, back) they say
//   dot(p, side) + tangent dot(p, back) <= dot(e, side) + tangent d   and the same of -side,
// so that both touch if d = (most + least) / (2 tangent) and dot(e, side) = (most - least) / 2.
struct Planes {
  double most, least;       // of dot(p, side) + tangent dot(p, back), and of -side
  dvec3 at_most, at_least;  // points that touch

  double depth(double tangent) const { return (most + least) / (2 * tangent); }
  double middle() const { return (most - least) / 2; }
};

Planes planes_about(const SubjectPoints& points, const dvec3& side, const dvec3& back, double tangent) {
  const auto along = [](const dvec3& w) { return [w](const dvec3& p) { return glm::dot(p, w); }; };
  const auto most = points.farthest(along(side + tangent * back)),
             least = points.farthest(along(-side + tangent * back));
  return {most.value, least.value, most.point, least.point};
}

// Where the eye is along `side` if the projections are to be in the middle at a depth that leaves them room:
// where both planes of a smaller tangent touch. g(t) = most + least - 2 t d is convex and falls, and Newton's
// steps meet its root from the left after the first; g is piecewise linear, so they end.
double middle_at(const SubjectPoints& points, const dvec3& side, const dvec3& back, double tangent,
                 double depth) {
  Planes planes = planes_about(points, side, back, tangent);
  for (int step = 0; step < 32; ++step) {
    const double rise = glm::dot(planes.at_least - planes.at_most, side),
                 slope = glm::dot(planes.at_least + planes.at_most, back) - 2 * depth;
    const double next = slope < 0 ? std::max(0.0, rise / slope) : tangent;
    if (std::abs(next - tangent) <= 1e-12 * std::abs(tangent)) break;
    tangent = next;
    planes = planes_about(points, side, back, tangent);
  }
  return planes.middle();
}

}  // namespace

Sides sides_about(const vec3& up) {
  Sides sides;
  sides.up = glm::normalize(dvec3(up));
  const Axis axis = nearest_axis(up);
  const dvec3 front = axis == Axis::z         ? dvec3(0, -1, 0)
                      : axis == Axis::minus_z ? dvec3(0, 1, 0)
                                              : dvec3(0, 0, 1);
  sides.front = glm::normalize(front - glm::dot(front, sides.up) * sides.up);
  sides.right = glm::cross(sides.up, sides.front);
  return sides;
}

Camera framing_camera(const Scene& scene, const TriangleMesh& mesh) {
  const SubjectPoints points(mesh);
  const Axes axes = axes_of(sides_about(scene.camera.up), scene.view.azimuth, scene.view.elevation);
  const Tangents t = tangents_of(scene);
  const Planes across = planes_about(points, axes.right, axes.back, t.x),
               along = planes_about(points, axes.up, axes.back, t.y);
  const double nearest =
      points.farthest([&](const dvec3& p) { return glm::dot(p, axes.back); }).value + least_depth(mesh);
  const double depth = std::max({across.depth(t.x), along.depth(t.y), nearest});
  const dvec3 eye = middle_at(points, axes.right, axes.back, t.x, depth) * axes.right +
                    middle_at(points, axes.up, axes.back, t.y, depth) * axes.up + depth * axes.back;
  return camera_at(scene, mesh, axes, eye, depth - glm::dot(middle_of(mesh), axes.back));
}

// A point at height h over the middle, r from the axis, is at every place of a circle. About the axis, with
// the elevation's sine s and cosine c and the place's angle f seen from the eye, it has
//   dot(p, right) = r sin f,   dot(p, up) = c h - s r cos f,   dot(p, back) = s h + c r cos f,
// and the largest of dot(p, side) + tangent dot(p, back) over f is r times the length of the terms in f.
std::vector<Camera> framing_turn(const Scene& scene, const TriangleMesh& mesh, unsigned count) {
  const SubjectPoints points(mesh);
  const Sides sides = sides_about(scene.camera.up);
  const double s = std::sin(scene.view.elevation * degrees), c = std::cos(scene.view.elevation * degrees);
  const Tangents t = tangents_of(scene);
  const dvec3 middle = middle_of(mesh);
  const auto most = [&](double of_radius, double of_height) {
    return points
        .farthest([&](const dvec3& p) {
          const double h = glm::dot(p - middle, sides.up);
          const double r = glm::length(p - middle - h * sides.up);
          return of_radius * r + of_height * h;
        })
        .value;
  };
  const double across = most(std::hypot(1.0, t.x * c), t.x * s),
               over = most(std::abs(t.y * c - s), c + t.y * s),
               under = most(std::abs(t.y * c + s), t.y * s - c);
  const double depth = std::max({across / t.x, (over + under) / (2 * t.y), most(c, s) + least_depth(mesh)});
  // The middle of the heights at this depth: of the tangents at which both planes touch, by bisection.
  double low = 0, high = t.y;
  const auto reach = [&](double tangent, double side) {
    return most(std::abs(tangent * c - side * s), tangent * s + side * c);
  };
  for (int step = 0; step < 60; ++step) {
    const double tangent = 0.5 * (low + high);
    (reach(tangent, 1) + reach(tangent, -1) > 2 * tangent * depth ? low : high) = tangent;
  }
  const double height = 0.5 * (reach(high, 1) - reach(high, -1));
  std::vector<Camera> cameras;
  for (unsigned i = 0; i < count; ++i) {
    const Axes axes = axes_of(sides, scene.view.azimuth + 360.0 * i / count, scene.view.elevation);
    cameras.push_back(camera_at(scene, mesh, axes, middle + height * axes.up + depth * axes.back, depth));
  }
  return cameras;
}

}  // namespace nook
