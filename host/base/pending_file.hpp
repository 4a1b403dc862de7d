#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>

namespace nook {

/// A file that appears under its name only when it is complete: written under a temporary name in the same
/// folder (.NAME.part), then renamed. Destroyed without commit(), it leaves nothing behind and an older file
/// of that name as it was. What a killed process left of its temporary file is used by the next for that
/// name.
///
///     PendingFile file(path);
///     file.write(text.data(), text.size());
///     file.commit();
///
/// Every failure throws Error(output) with the line "cannot write PATH: REASON". A symbolic link stays one:
/// its target is replaced. Only regular files can be replaced.
class PendingFile {
 public:
  explicit PendingFile(const std::filesystem::path& path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void seek(std::size_t position);
  std::size_t position() const { return position_; }
  /// Waits until what is written is on the disk: after commit() even a power cut leaves the old file or the
  /// new one.
  void sync();
  void commit();

 private:
  void discard();
  /// Null, and errno, if none can be made.
  std::FILE* open_temporary();
  [[noreturn]] void fail(int error);

  std::filesystem::path path_;       ///< as the user named it; for messages
  std::filesystem::path target_;     ///< what is replaced
  std::filesystem::path temporary_;  ///< empty once committed or removed
  std::FILE* stream_ = nullptr;
  std::size_t position_ = 0;
  int error_ = 0;  ///< the first errno: later calls, and commit(), fail with it too
};

}  // namespace nook
