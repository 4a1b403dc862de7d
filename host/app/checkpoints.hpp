#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "render/session.hpp"

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

/// Keeps a session's part on disk.
class CheckpointWriter {
 public:
  /// An empty path writes nothing.
  CheckpointWriter(std::filesystem::path file, double every) : file_(std::move(file)), every_(every) {}
  /// Writes if `every` seconds have passed since the last time (more where writing takes long). A failure
  /// costs a warning: the older file is still there, and the render goes on.
  void update(Session& session);
  /// Writes. Throws Error(output).
  void write(Session& session);
  const std::filesystem::path& file() const { return file_; }
  /// "; FILE holds 43.2 % of the samples, --resume goes on from there", or "; nothing was written".
  std::string what_is_kept(const Session& session) const;

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path file_;
  double every_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace nook
