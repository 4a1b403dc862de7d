#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "image/compare.hpp"

namespace nook {

namespace {

const char* verdict(CompareStatus status) {
  switch (status) {
    case CompareStatus::same:
      return "PASS";
    case CompareStatus::warning:
      return "WARNING";
    case CompareStatus::failure:
      return "FAILURE";
    default:
      return "INCOMPARABLE";
  }
}

double percent(std::uint64_t part, const Comparison& c) {
  return 100.0 * static_cast<double>(part) / (static_cast<double>(c.width) * c.height);
}

}  // namespace

std::string comparison_text(const Comparison& c, const CompareOptions& options) {
  std::string text = fmt::format("{} against {}\n", options.a.string(), options.b.string());
  if (c.status == CompareStatus::incomparable) return text + c.reason + "\n" + verdict(c.status) + "\n";

  text +=
      fmt::format("{} x {} pixels\n\n{:<12}{:>11}{:>11}{:>11}{:>11}{:>9}{:>9}{:>12}{:>10}\n", c.width,
                  c.height, "channel", "RMSE", "MAE", "max", "relMSE", "PSNR/dB", "SSIM", "mean(a-b)", "z");
  for (const auto& [name, m] : c.channels) {
    text +=
        fmt::format("{:<12}{:>11.4g}{:>11.4g}{:>11.4g}{:>11.4g}{:>9.2f}{:>9.4f}{:>12.4g}{:>10.2f}\n", name,
                    m.rmse, m.mae, m.max_abs, m.rel_mse, m.psnr, m.ssim, m.mean_difference, m.z_score);
    if (options.reference_variance)
      text += fmt::format("{:<12}{:>11.4g}  with the reference's variance subtracted\n", "",
                          m.rmse_without_reference_noise);
    if (m.non_finite)
      text +=
          fmt::format("{:<12}{:>11}  pixels left out: not finite in one of the images\n", "", m.non_finite);
  }
  text += "\n";
  if (c.worst.difference != 0)
    text += fmt::format("largest difference {:.6g} at pixel ({}, {}), channel {}: {:.6g} against {:.6g}\n",
                        c.worst.difference, c.worst.x, c.worst.y, c.worst.channel, c.worst.a, c.worst.b);
  if (c.pixels_over_warn)
    text += fmt::format("{} pixels ({:.3g} %) differ by more than {:g} (warning)\n", c.pixels_over_warn,
                        percent(c.pixels_over_warn, c), options.warn.each);
  if (c.pixels_over_fail)
    text += fmt::format("{} pixels ({:.3g} %) differ by more than {:g} (failure)\n", c.pixels_over_fail,
                        percent(c.pixels_over_fail, c), options.fail.each);
  return text + verdict(c.status) + "\n";
}

std::string comparison_json(const Comparison& c, const CompareOptions& options) {
  nlohmann::ordered_json json = {
      {"a", options.a.string()}, {"b", options.b.string()}, {"verdict", verdict(c.status)}};
  if (c.status == CompareStatus::incomparable) {
    json["reason"] = c.reason;
    return json.dump(2) + "\n";
  }
  json["width"] = c.width;
  json["height"] = c.height;
  for (const auto& [name, m] : c.channels) {
    nlohmann::ordered_json channel = {
        {"channel", name}, {"pixels", m.pixels}, {"non_finite", m.non_finite}, {"rmse", m.rmse}};
    if (options.reference_variance) channel["rmse_without_reference_noise"] = m.rmse_without_reference_noise;
    channel.update({{"mae", m.mae},
                    {"max_abs", m.max_abs},
                    {"rel_mse", m.rel_mse},
                    {"psnr", m.psnr},
                    {"ssim", m.ssim},
                    {"mean_difference", m.mean_difference},
                    {"z_score", m.z_score}});
    json["channels"].push_back(channel);
  }
  json["pixels_over_warn"] = c.pixels_over_warn;
  json["pixels_over_fail"] = c.pixels_over_fail;
  if (c.worst.difference != 0)
    json["worst"] = {{"channel", c.worst.channel},
                     {"x", c.worst.x},
                     {"y", c.worst.y},
                     {"a", c.worst.a},
                     {"b", c.worst.b},
                     {"difference", c.worst.difference}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace nook
