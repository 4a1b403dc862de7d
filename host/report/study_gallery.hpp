#pragma once

#include "report/study_methods.hpp"

namespace nook {

/// A picture for a study's page.
struct GalleryPicture {
  std::string group;   ///< "reference", "equal time", "equal error", "screen space"
  std::string name;    ///< of the method
  std::string detail;  ///< level, seconds, error
  std::vector<float> image;
  std::vector<std::uint32_t> samples;  ///< may be empty
};

/// Pictures of one scene by the plainest and the best methods, at equal time and at equal error: the time
/// that the best one takes for 128 samples a pixel, and the error that it then has, where others can afford
/// it. All takes about `seconds`, half of them for the reference.
std::vector<GalleryPicture> make_gallery(const StudyScene& scene, double seconds, std::uint32_t seed);

}  // namespace nook
