#pragma once

#include <filesystem>
#include <string>

#include "report/study.hpp"
#include "report/study_methods.hpp"

namespace nook {

/// A picture of the study's size as its reference: R, and AO.variance if it is there. Throws Error(scene).
StudyReference given_reference(const std::filesystem::path& file, int width, int height);

/// `file`, if it was made for `identity`; otherwise rendered in about `seconds` and kept there.
StudyReference cached_reference(const StudyScene& scene, const std::filesystem::path& file,
                                const std::string& identity, double seconds);

}  // namespace nook
