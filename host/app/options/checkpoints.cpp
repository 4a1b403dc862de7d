#include "app/options/checkpoints.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "base/error.hpp"

namespace nook {
namespace {

// A variable that Slurm sets for the tasks of an array.
std::uint32_t slurm_number(const char* name, std::optional<std::uint32_t> fallback) {
  const char* text = std::getenv(name);
  if (!text && fallback) return *fallback;
  std::uint32_t value = 0;
  const char* end = text ? text + std::string_view(text).size() : nullptr;
  if (!text || std::from_chars(text, end, value).ptr != end || text == end)
    throw Error(ErrorKind::usage, fmt::format("--shard slurm: {} is {}", name,
                                              text ? fmt::format("'{}', not a number", text)
                                                   : "not set: this is no task of a Slurm array"));
  return value;
}

Share checked(std::uint32_t index, std::uint32_t count, const std::string& text) {
  if (index < 1 || index > count)
    throw Error(ErrorKind::usage, fmt::format("--shard: '{}' is not I/N with 1 <= I <= N", text));
  return {index - 1, count};
}

}  // namespace

void CheckpointOptions::add_to(CLI::App& command) {
  command.add_option("--checkpoint", checkpoint,
                     "Keep finished samples in this file; nook merge and --resume read it");
  command.add_option("--every", every, "Seconds between checkpoints; default 60")
      ->check(CLI::Range(0.0, 1e9));
  command.add_flag("--resume", resume, "Go on from the checkpoint if there is one");
  command
      .add_option("--shard", shard,
                  "Render part I of N, to be joined by nook merge: I/N, or slurm in a Slurm array")
      ->envname("NOOK_SHARD");
}

std::optional<Share> CheckpointOptions::share() const {
  if (shard.empty()) return std::nullopt;
  if (shard == "slurm") {
    const std::uint32_t id = slurm_number("SLURM_ARRAY_TASK_ID", {}),
                        count = slurm_number("SLURM_ARRAY_TASK_COUNT", {});
    const std::uint32_t first = slurm_number("SLURM_ARRAY_TASK_MIN", 0),
                        step = slurm_number("SLURM_ARRAY_TASK_STEP", 1);
    const std::string place = fmt::format("task {} of {} from {}", id, count, first);
    if (id < first || step == 0) throw Error(ErrorKind::usage, "--shard slurm: impossible: " + place);
    return checked((id - first) / step + 1, count, place);
  }
  std::uint32_t index = 0, count = 0;
  const char* end = shard.data() + shard.size();
  const auto [slash, first] = std::from_chars(shard.data(), end, index);
  if (first != std::errc() || slash == end || *slash != '/') return checked(0, 0, shard);
  const auto [stop, second] = std::from_chars(slash + 1, end, count);
  if (second != std::errc() || stop != end) return checked(0, 0, shard);
  return checked(index, count, shard);
}

std::filesystem::path CheckpointOptions::file(const std::filesystem::path& scene,
                                              const std::filesystem::path& output) const {
  if (every && std::isnan(*every)) throw Error(ErrorKind::usage, "--every: 'nan' is not a number of seconds");
  const std::optional<Share> part = share();
  std::filesystem::path file = checkpoint;
  if (part) {
    if (!checkpoint.empty() && !output.empty())
      throw Error(ErrorKind::usage, "--shard: its part is --checkpoint's file or -o's, not both");
    if (file.empty()) file = output;
    if (file.empty())
      file = std::filesystem::path(scene).replace_extension(
          fmt::format(".{}of{}.nook", part->index + 1, part->count));
  }
  if (file.empty()) {
    if (resume) throw Error(ErrorKind::usage, "--resume: needs --checkpoint FILE");
    if (every) throw Error(ErrorKind::usage, "--every: needs --checkpoint FILE");
    return file;
  }
  std::error_code code;
  if (!resume && std::filesystem::exists(file, code))
    throw Error(ErrorKind::usage,
                fmt::format("{} exists: --resume goes on from it; otherwise remove it first", file.string()));
  return file;
}

}  // namespace nook
