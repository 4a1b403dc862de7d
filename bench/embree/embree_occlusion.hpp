#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/embree/embree_scene.hpp"
#include "bench/support/rays.hpp"

namespace nook::bench {

/// The same queries through one of Embree's interfaces, ray generation included. `threads` threads take
/// chunks of points from a counter. Each returns seconds.
struct EmbreeVariant {
  std::string name;
  std::function<double(const EmbreeScene&, const std::vector<RayPoint>&, const DirectionSets&,
                       float max_distance, unsigned threads, std::vector<std::uint32_t>& bits)>
      shared;
  std::function<double(const EmbreeScene&, const std::vector<RayPoint>&, const DirectionSets&,
                       float max_distance, unsigned threads, std::vector<std::uint32_t>& bits)>
      own;
  std::function<double(const EmbreeScene&, const vec3& eye, const std::vector<vec3>& directions,
                       unsigned threads, std::vector<float>& distances)>
      closest;
};

/// occluded1/4/8/16, and of Embree 3 1M and Np streams, each for coherent and incoherent contexts.
std::vector<EmbreeVariant> embree_variants();

}  // namespace nook::bench
