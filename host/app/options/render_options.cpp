#include "app/options/render_options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>

#include "app/options/key_flags.hpp"
#include "base/error.hpp"
#include "render/run_checks.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

// One file for each output: the last one written would replace the others.
void check_outputs(const RenderOptions& options) {
  std::vector<fs::path> files;
  for (const fs::path& file : {options.output, options.stats, options.checkpoints.checkpoint})
    if (!file.empty()) files.push_back(fs::absolute(file).lexically_normal());
  std::sort(files.begin(), files.end());
  const auto twice = std::adjacent_find(files.begin(), files.end());
  if (twice != files.end())
    throw Error(ErrorKind::usage, fmt::format("{}: two outputs cannot share a file", twice->string()));
  if (options.png && options.output.extension() == ".png")
    throw Error(ErrorKind::usage, Place{options.output.string()},
                "is the preview's name; name an .exr file, or say --no-png");
}

}  // namespace

void RenderOptions::add_to(CLI::App& command) {
  scene.add_to(command);
  device.add_to(command);
  checkpoints.add_to(command);
  target.add_to(command);
  command.add_option("-o,--output", output,
                     "EXR file; default: beside the scene, .exr for .toml. With --shard: the part's file");
  command.add_option("--aov", aovs, "More channels: normal,position,depth,variance,samples,alpha")
      ->delimiter(',');
  command.add_option("--progress", progress, "auto, plain, json or none (to stderr)")
      ->envname("NOOK_PROGRESS");
  command.add_option("--frames", frames, "SSAO: draw the frame so often, and report the fastest")
      ->check(CLI::Range(1, 100000));
  command
      .add_option("--turntable", turntable,
                  "Render this number of pictures along a full turn of the eye about `at`: out_0000.exr, "
                  "out_0001.exr, ...")
      ->check(CLI::Range(1, 100000));
  command.add_option("--stats", stats, "Write the run record as JSON");
  command.add_flag("--png,!--no-png", png,
                   "Write a PNG preview beside the EXR (sRGB encoded); on by default");
  scene.add_background_to(command);
  command.add_flag("--denoise", denoise, help_text(*key_of_flag("--denoise")));
  command.add_flag("--quiet", quiet, "Say nothing but errors");
  command.add_flag("--print-config", print_config,
                   "Print the scene with every override and default, render nothing");
}

StopTarget RenderOptions::check(const Scene& loaded) const {
  check_outputs(*this);
  const StopTarget stop = target.resolve(loaded, scene.has("--spp"));
  if (stop.any()) check_samples(loaded, stop.max_spp);
  scene.check_applicable(loaded);
  const auto any = [&](auto kind) {
    return std::any_of(loaded.effects.begin(), loaded.effects.end(),
                       [&](const Effect& e) { return kind(e.kind); });
  };
  const bool sampled = any(is_traced);
  const bool screen_space = any([](EffectKind kind) { return kind == EffectKind::ssao; });
  const bool shard = checkpoints.share().has_value();
  const bool kept = shard || checkpoints.resume || !checkpoints.file(scene.scene, output).empty();
  const auto fail = [](const char* why) { throw Error(ErrorKind::usage, why); };
  if (!sampled && stop.any()) fail("--error, --time: the scene has no effect with samples");
  if (!sampled && denoise) fail("--denoise: the scene has no effect with samples");
  if (loaded.denoise && shard)
    fail("--denoise, --shard: a share of a picture is not denoised; render it whole, or leave denoise out");
  if (!sampled && kept) fail("--checkpoint, --resume, --shard: the scene has no effect with samples to keep");
  if (screen_space && shard)
    fail("--shard: a screen-space layer cannot be merged; render it with a scene of its own");
  if (!screen_space && frames) fail("--frames: the scene has no screen-space effect to draw again");
  if (stop.error && shard) fail("--error: a share of a picture (--shard) has a fixed number of samples");
  if (stop.seconds && shard) fail("--time: a share of a picture (--shard) has a fixed number of samples");
  Scene resolved = loaded;
  resolved.stop = stop;
  if (const auto conflict = conflict_of_run(resolved))
    throw Error(ErrorKind::usage, fmt::format("--{}: {}", conflict->key, conflict->what));
  if (target.dry_run && (kept || !stats.empty()))
    fail("--dry-run: renders nothing that --checkpoint, --resume, --shard or --stats could keep");
  return stop;
}

std::filesystem::path RenderOptions::picture_file() const {
  return output.empty() ? fs::path(scene.scene).replace_extension(".exr") : output;
}

void check_extension(const fs::path& file, std::span<const std::string_view> written) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (!extension.empty() && std::find(written.begin(), written.end(), extension) == written.end())
    throw Error(ErrorKind::usage, Place{file.string()},
                fmt::format("not a format that is written here ({})", fmt::join(written, ", ")));
}

void check_writable(const fs::path& file) {
  std::error_code code;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code))
    throw Error(ErrorKind::output, Place{file.string()},
                fmt::format("the folder {} does not exist", folder.string()));
  if (fs::is_directory(file, code)) throw Error(ErrorKind::output, Place{file.string()}, "is a folder");
  if (fs::exists(file, code) && !fs::is_regular_file(file, code))
    throw Error(ErrorKind::output, Place{file.string()}, "not a regular file");
  if (access(folder.c_str(), W_OK) != 0)
    throw Error(ErrorKind::output, Place{file.string()},
                fmt::format("the folder {} is not writable", folder.string()));
}

}  // namespace nook
