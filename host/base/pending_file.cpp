#include "base/pending_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>

#include "base/error.hpp"

namespace nook {

namespace fs = std::filesystem;

PendingFile::PendingFile(const fs::path& path) : path_(path), target_(path) {
  std::error_code ignored;
  if (fs::is_symlink(path, ignored)) {
    const fs::path resolved = fs::weakly_canonical(path, ignored);
    if (!ignored) target_ = resolved;
  }
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (status.type() == fs::file_type::none) fail(error.value());
  if (fs::is_directory(status)) fail(EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Error(ExitCode::output, fmt::format("cannot write {}: not a regular file", path_.string()));
  if (target_.filename().empty()) fail(EISDIR);

  std::random_device random;
  for (int attempt = 0; attempt < 16; ++attempt) {
    // A file name has at most 255 bytes; the temporary one must fit whenever the final one does.
    const std::string stem = target_.filename().string().substr(0, 200);
    temporary_ = target_.parent_path() / fmt::format(".{}.{:08x}.part", stem, random());
    const int descriptor = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      stream_ = ::fdopen(descriptor, "wb");
      if (!stream_) {
        const int reason = errno;
        ::close(descriptor);
        fail(reason);
      }
      return;
    }
    if (errno != EEXIST) break;
  }
  const int reason = errno;
  temporary_.clear();
  fail(reason);
}

PendingFile::~PendingFile() {
  if (stream_) std::fclose(stream_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void PendingFile::write(const void* data, std::size_t bytes) {
  if (error_) fail(error_);
  if (bytes == 0) return;  // an empty vector's data may be null, which fwrite must not be given
  errno = 0;
  if (std::fwrite(data, 1, bytes, stream_) != bytes) fail(errno ? errno : EIO);
  position_ += bytes;
}

void PendingFile::seek(std::size_t position) {
  if (error_) fail(error_);
  errno = 0;
  if (::fseeko(stream_, static_cast<off_t>(position), SEEK_SET) != 0) fail(errno ? errno : EIO);
  position_ = position;
}

void PendingFile::sync() {
  if (error_) fail(error_);
  errno = 0;
  if (std::fflush(stream_) != 0 || ::fsync(::fileno(stream_)) != 0) fail(errno ? errno : EIO);
}

void PendingFile::commit() {
  if (error_) fail(error_);
  std::FILE* stream = stream_;
  stream_ = nullptr;
  errno = 0;
  // Both, even if the first fails: close reports what a network file system found out late.
  const bool flushed = std::fflush(stream) == 0;
  const int flush_error = errno;
  const bool closed = std::fclose(stream) == 0;
  if (!flushed) fail(flush_error);
  if (!closed) fail(errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void PendingFile::fail(int error) {
  error_ = error;
  // A constructor that throws runs no destructor.
  if (stream_) std::fclose(stream_);
  stream_ = nullptr;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  throw Error(ExitCode::output,
              fmt::format("cannot write {}: {}", path_.string(), std::generic_category().message(error)));
}

}  // namespace nook
