#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "trace/session.hpp"

namespace nook {

/// --checkpoint, --every, --resume, --shard.
struct CheckpointOptions {
  std::filesystem::path checkpoint;
  std::optional<double> every;  ///< seconds; default 60
  bool resume = false;
  std::string shard;

  void add_to(CLI::App& command);
  /// The share that --shard names: "2/8", or "slurm" for the task of a Slurm array. Unset: the whole picture,
  /// and an EXR of it. Throws Error(usage).
  std::optional<Share> share() const;
  /// The part's file: --checkpoint, else, for a shard, `output` or SCENE.2of8.nook; empty if no part is kept.
  /// Throws Error(usage) for options that contradict each other, and for a file that exists, which only
  /// --resume may replace.
  std::filesystem::path file(const std::filesystem::path& scene, const std::filesystem::path& output) const;
};

}  // namespace nook
