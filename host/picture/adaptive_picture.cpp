#include "picture/adaptive_picture.hpp"

#include "picture/picture.hpp"

namespace nook {

Image adaptive_picture(const Plan& plan, const FilmPart& part, const AdaptiveResult& result) {
  Image image = make_picture(part);
  bool main_values = false;
  for (std::size_t e = 0; e < result.effects.size(); ++e) {
    const PixelEstimates& made = result.effects[e];
    const std::string& layer = part.layers[e];
    const bool bent = plan.effects[e].effect.kind == EffectKind::bent;
    const std::string of_effect = layer.empty() ? "AO." : layer;
    main_values = main_values || (layer.empty() && !bent);
    for (Channel& channel : image.channels) {
      if (bent ? channel.name == layer + "AO"
               : channel.name == layer + "R" || channel.name == layer + "G" || channel.name == layer + "B")
        channel.values = made.value;
      if (channel.name == of_effect + "variance") channel.values = made.variance;
      if (channel.name == of_effect + "samples") channel.values = made.samples;
    }
  }
  // R, G, B repeat the first three channels then (make_picture()).
  for (std::size_t i = 0; i < 3 && !main_values; ++i)
    for (Channel& channel : image.channels)
      if (channel.name == std::string(1, "RGB"[i])) channel.values = image.channels[i].values;
  return image;
}

}  // namespace nook
