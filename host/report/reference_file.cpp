#include "report/reference_file.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "base/error.hpp"
#include "image/exr.hpp"

namespace nook {

StudyReference given_reference(const std::filesystem::path& file, int width, int height) {
  const Image image = read_exr(file);
  if (image.width != width || image.height != height)
    throw Error(ErrorKind::scene, Place{file.string()},
                fmt::format("is {}x{}, the study is {}x{} (--size sets it)", image.width, image.height, width,
                            height));
  const auto plane = [&](const char* name) -> const std::vector<float>* {
    const Channel* channel = image.find(name);
    return channel ? std::get_if<std::vector<float>>(&channel->values) : nullptr;
  };
  if (!plane("R")) throw Error(ErrorKind::scene, Place{file.string()}, "has no channel R");
  StudyReference reference;
  reference.image = *plane("R");
  if (const auto* variance = plane("AO.variance")) reference.variance = *variance;
  reference.description = file.string();
  if (const auto spp = image.metadata.find("nook/spp"); spp != image.metadata.end())
    reference.spp = std::strtoull(spp->second.c_str(), nullptr, 10);
  return reference;
}

StudyReference cached_reference(const StudyScene& scene, const std::filesystem::path& file,
                                const std::string& identity, double seconds) {
  std::error_code code;
  if (std::filesystem::exists(file, code)) {
    const Image image = read_exr(file);
    const auto made_for = image.metadata.find("nook/study");
    if (made_for != image.metadata.end() && made_for->second == identity) {
      StudyReference reference = given_reference(file, scene.width(), scene.height());
      reference.description = image.metadata.at("nook/description");
      reference.seconds = std::strtod(image.metadata.at("nook/seconds_render").c_str(), nullptr);
      return reference;
    }
  }
  StudyReference reference = scene.reference(seconds);
  Image image;
  image.width = scene.width();
  image.height = scene.height();
  for (const char* channel : {"R", "G", "B"}) image.channels.push_back({channel, reference.image});
  image.channels.push_back({"AO.variance", reference.variance});
  image.metadata = {{"nook/study", identity},
                    {"nook/description", reference.description},
                    {"nook/spp", std::to_string(reference.spp)},
                    {"nook/seconds_render", fmt::format("{:.3f}", reference.seconds)}};
  write_exr(file, image);
  return reference;
}

}  // namespace nook
