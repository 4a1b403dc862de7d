// nook merge PART...: parts of a picture (shards, checkpoints) joined to the picture, or to a larger part.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <vector>

#include "app/commands.hpp"
#include "app/commands/render_report.hpp"
#include "app/exit_code.hpp"
#include "app/options/render_options.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "film/film_part_file.hpp"
#include "image/exr.hpp"
#include "image/png.hpp"
#include "picture/picture.hpp"
#include "report/run_record.hpp"
#include "scene/scene_toml.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::vector<fs::path> parts;
  fs::path output;
  bool status = false, partial = false, any_device = false, png = true, quiet = false;
};

double percent(const SampleBoxes& boxes, const FilmPart& part) {
  return 100.0 * double(samples_in(boxes)) / double(part.whole().samples());
}

// "samples 0-15 of 4800 pixels", the first few.
std::string describe(const SampleBoxes& boxes) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> pixels;
  for (const SampleBox& box : boxes) pixels[{box.first, box.end}] += box.pixel_end - box.pixel_begin;
  std::string text;
  std::size_t listed = 0;
  for (const auto& [range, count] : pixels) {
    if (++listed > 8) return text + ", ...";
    text += fmt::format("{}samples {}-{} of {}", text.empty() ? "" : ", ", range.first, range.second - 1,
                        counted(count, "pixel"));
  }
  return text.empty() ? "none" : text;
}

FilmPart join(const MergeOptions& options) {
  FilmPart joined;
  for (const fs::path& path : options.parts) {
    FilmPart part = read_film_part(path);
    if (options.any_device)
      std::erase_if(part.identity,
                    [](const auto& entry) { return entry.first == "device" || entry.first == "driver"; });
    if (options.status)
      fmt::print("{}: {:.2f} %: {}\n", path.string(), percent(part.held, part), describe(part.held));
    if (joined.films.empty())
      joined = std::move(part);
    else
      join_film_part(joined, options.parts.front().string(), part, path.string());
  }
  return joined;
}

// As the scene has it that the parts are of; black if they do not say it.
Background background_of(const Image& image) {
  const auto scene = image.metadata.find("nook/scene");
  return scene == image.metadata.end() ? Background{} : parse_scene(scene->second, "").background;
}

int merge(const MergeOptions& options) {
  if (options.output.empty() && !options.status)
    throw Error(ErrorKind::usage, "merge: needs -o OUT.exr, -o PART.nook or --status");
  static constexpr std::string_view written[] = {".exr", ".nook"};
  check_extension(options.output, written);
  FilmPart part = join(options);
  const SampleBoxes missing = part.complete() ? SampleBoxes() : subtract({part.whole()}, part.held);
  if (options.status) fmt::print("missing: {:.2f} %: {}\n", percent(missing, part), describe(missing));
  if (options.output.empty()) return missing.empty() ? 0 : int(ExitCode::target);

  if (options.output.extension() != ".exr") {
    write_film_part(options.output, part);
    return 0;
  }
  if (!missing.empty() && !options.partial)
    throw Error(ErrorKind::incomplete,
                fmt::format("{:.2f} % of the picture is missing: {}; --partial writes it all the same",
                            percent(missing, part), describe(missing)));
  if (!part.films.front().kept.empty())
    throw Error(ErrorKind::usage, Place{options.parts.front().string()},
                "a render to an error; nook render --resume makes its picture");
  Image image = make_picture(part);
  place_crop(image, part.identity);
  for (const auto& [name, value] : count_metadata(part.counts, part.render_seconds))
    image.metadata[name] = value;
  if (!missing.empty() || options.any_device)
    image.metadata["nook/not_repeatable"] =
        missing.empty() ? "its parts may be from different devices" : "it is of parts that lack samples";
  write_exr(options.output, image);
  if (options.png) write_png(fs::path(options.output).replace_extension(".png"), image, background_of(image));
  if (!options.quiet) warn_of_rejected(part.counts.rejected);
  return 0;
}

}  // namespace

void add_merge_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command =
      app.add_subcommand("merge", "Join parts of a picture (nook render --shard, --checkpoint)");
  command->add_option("parts", options->parts, "Parts, in any order")->required();
  command->add_option("-o,--output", options->output, "OUT.exr for the picture, PART.nook for a larger part");
  command->add_flag("--status", options->status,
                    "Print which samples each part has, and which are missing (exit code 5 if any)");
  command->add_flag("--partial", options->partial, "Write the picture though samples are missing");
  command->add_flag("--any-device", options->any_device,
                    "Join parts from different devices: the same samples, not the same bits as one run");
  command->add_flag("--png,!--no-png", options->png, "Write a PNG preview beside the EXR; on by default");
  command->add_flag("--quiet", options->quiet, "Say nothing but errors");
  command->callback([options, &chosen] { chosen = [options] { return merge(*options); }; });
}

}  // namespace nook
