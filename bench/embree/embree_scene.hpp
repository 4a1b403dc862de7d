#pragma once

#include "mesh/triangle_mesh.hpp"
#include "support/embree.hpp"

namespace nook::bench {

/// A mesh committed to Embree at MEDIUM quality.
class EmbreeScene {
 public:
  EmbreeScene(const TriangleMesh& mesh, bool robust, unsigned threads);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene get() const { return scene_; }
  double commit_seconds() const { return commit_seconds_; }

 private:
  RTCDevice device_;
  RTCScene scene_;
  double commit_seconds_ = 0;
};

}  // namespace nook::bench
