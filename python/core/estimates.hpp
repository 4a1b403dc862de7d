#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "math/background.hpp"
#include "render/observer.hpp"
#include "workspace.hpp"

namespace nook::python {

/// Estimates of one effect, a number for each point; of type bent, direction has three.
struct Estimates {
  std::vector<float> value, standard_error, direction, half_angle;
  std::vector<std::uint32_t> samples;
};

/// What is asked of a scene at points: x, y, z each.
struct PointRequest {
  EffectKind kind = EffectKind::ao;
  std::vector<double> points, normals, views;
  std::vector<vec2> point_set;  ///< in [0,1)^2, to take directions from; empty: the scene's sampler
  bool shift_points = true;     ///< Plan::shift_points
  std::uint32_t samples = 1024;
  std::string settings;
};

/// As `nook probe` makes it, to the same bits. Throws Error.
Estimates estimate(Workspace& workspace, const PointRequest& request, RunObserver& observer);

/// A layer of a picture and the channels of its components.
struct Layer {
  std::string name;
  std::vector<std::string> channels;
};

std::vector<Layer> layers_of(const Plan& plan);

struct Picture {
  Image image;
  Background background;  ///< of its PNG
  std::vector<Layer> layers;
  bool complete = true;  ///< no stop rule was left unsatisfied
};

/// As `nook render` makes it, to the same bits. Throws Error.
Picture render(Workspace& workspace, const std::string& settings, const std::vector<std::string>& aovs,
               RunObserver& observer);

}  // namespace nook::python
