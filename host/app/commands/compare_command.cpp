// nook compare A.exr B.exr: how far an image is from a reference, with idiff's thresholds and exit codes.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/options/render_options.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"
#include "image/compare.hpp"
#include "image/error_image.hpp"

namespace nook {
namespace {

struct Options {
  CompareOptions compare;
  std::optional<std::filesystem::path> error_image;
  bool json = false, quiet = false;
};

int run(const Options& options) {
  static constexpr std::string_view written[] = {".png", ".exr"};
  if (options.error_image) check_extension(*options.error_image, written);
  if (options.error_image)
    for (const std::filesystem::path& input : {options.compare.a, options.compare.b}) {
      std::error_code code;
      if (std::filesystem::equivalent(input, *options.error_image, code))
        throw Error(ErrorKind::output, fmt::format("--error-image: {} is compared, it would be overwritten",
                                                   options.error_image->string()));
    }
  Comparison comparison;
  try {
    comparison = compare_files(options.compare);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::scene) throw;
    to_stderr("nook: {}\n", error.what());
    return static_cast<int>(CompareStatus::unreadable);
  }
  if (!options.quiet)
    fmt::print("{}", options.json ? comparison_json(comparison, options.compare)
                                  : comparison_text(comparison, options.compare));
  if (options.error_image && comparison.status != CompareStatus::incomparable) {
    const double full_scale = write_error_image(*options.error_image, comparison.difference);
    if (!options.quiet && !options.json)
      fmt::print(
          "{}: {}\n", options.error_image->string(),
          options.error_image->extension() == ".exr"
              ? "the signed differences"
              : fmt::format("red above the reference, blue below, full colour from {:.3g} on", full_scale));
  }
  return static_cast<int>(comparison.status);
}

void add_limit(CLI::App& command, const std::string& name, const std::string& verdict,
               DifferenceLimit& limit) {
  const auto number = [](const std::string& text) {
    return std::isnan(std::strtod(text.c_str(), nullptr)) ? "'nan' is not a number" : "";
  };
  command.add_option("--" + name, limit.each, verdict + " if a value differs by more than this")
      ->capture_default_str()
      ->check(number);
  command.add_option("--" + name + "-percent", limit.percent, "Accept this many percent of such pixels")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0))
      ->check(number);
  command.add_option("--hard-" + name, limit.hard, verdict + " if any value differs by more than this")
      ->check(number);
}

}  // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("compare", "Compare an EXR image with a reference: RMSE, SSIM, z-score, verdict");
  command->add_option("image", options->compare.a, "EXR image")->required();
  command->add_option("reference", options->compare.b, "EXR image to compare it with")->required();
  command->add_option(
      "--reference-variance", options->compare.reference_variance,
      "EXR with the variance of the reference's pixels (channel AO.variance), subtracted from the RMSE");
  command
      ->add_option("--channels", options->compare.channels, "Channels to compare, or all; by default R,G,B")
      ->delimiter(',');
  add_limit(*command, "fail", "Failure", options->compare.fail);
  add_limit(*command, "warn", "Warning", options->compare.warn);
  command->add_option("--error-image", options->error_image,
                      "Where to write the signed difference: its values (.exr) or a picture (.png)");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing; the exit code says it");
  command->footer(
      "Exit codes, as idiff's: 0 the images agree, 1 warning, 2 failure, 3 not comparable, 4 unreadable.");
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace nook
