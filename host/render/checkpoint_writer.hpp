#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "trace/session.hpp"

namespace nook {

/// Keeps a session's part on disk.
class CheckpointWriter {
 public:
  /// An empty path writes nothing.
  CheckpointWriter(std::filesystem::path file, double every) : file_(std::move(file)), every_(every) {}
  /// Writes if `every` seconds have passed since the last time (more where writing takes long). A failure is
  /// returned in words ("" if there is none): the older file is still there, and the render may go on.
  std::string update(Session& session);
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
