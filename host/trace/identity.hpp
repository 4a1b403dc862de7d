#pragma once

#include <string>

#include "device/device.hpp"
#include "film/film_part.hpp"
#include "plan/plan.hpp"

namespace nook {

/// Everything that decides a film's bits, in words: what parts must agree in to be joined, or resumed.
/// `extra`: what else decides (a stop rule's parameters).
FilmPart::Texts film_identity(const Plan& plan, const DeviceInfo& device, const std::string& scene_hash,
                              const std::string& mesh_hash, const FilmPart::Texts& extra = {});

}  // namespace nook
