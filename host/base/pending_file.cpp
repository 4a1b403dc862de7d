#include "base/pending_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>

#include "base/error.hpp"

namespace nook {

namespace fs = std::filesystem;

namespace {

// A file of that name, new or left by a process that was killed, emptied, and locked as long as it is open;
// -1 where a living process writes it, or somebody else's is there. The lock goes with its process.
int open_unused(const fs::path& path) {
  constexpr int flags = O_WRONLY | O_NOFOLLOW | O_CLOEXEC;
  int file = ::open(path.c_str(), flags | O_CREAT | O_EXCL, 0666);
  const bool made = file >= 0;
  if (!made) file = ::open(path.c_str(), flags);
  if (file < 0) return -1;
  const bool locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  if (made && !locked && errno != EWOULDBLOCK) return file;  // no locks on this file system
  struct stat opened = {}, named = {};
  const bool ours = locked && ::fstat(file, &opened) == 0 && S_ISREG(opened.st_mode) &&
                    opened.st_nlink == 1 && opened.st_uid == ::geteuid() &&
                    // Whoever had it may have renamed it before it was locked here.
                    ::lstat(path.c_str(), &named) == 0 && named.st_ino == opened.st_ino &&
                    named.st_dev == opened.st_dev && ::ftruncate(file, 0) == 0;
  if (ours) return file;
  ::close(file);
  return -1;
}

}  // namespace

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
    throw Error(ErrorKind::output, fmt::format("cannot write {}: not a regular file", path_.string()));
  if (target_.filename().empty()) fail(EISDIR);

  stream_ = open_temporary();
  if (!stream_) {
    const int reason = errno;
    fail(reason);
  }
}

std::FILE* PendingFile::open_temporary() {
  // A file name has at most 255 bytes; the temporary one must fit whenever the final one does.
  const std::string stem = target_.filename().string().substr(0, 200);
  temporary_ = target_.parent_path() / fmt::format(".{}.part", stem);
  int descriptor = open_unused(temporary_);
  std::random_device random;
  for (int attempt = 0; attempt < 16 && descriptor < 0; ++attempt) {
    if (attempt > 0 && errno != EEXIST) break;
    temporary_ = target_.parent_path() / fmt::format(".{}.{:08x}.part", stem, random());
    descriptor = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  }
  std::FILE* stream = descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb");
  if (!stream) {
    const int reason = errno;
    if (descriptor >= 0)
      ::close(descriptor);
    else
      temporary_.clear();
    errno = reason;
  }
  return stream;
}

PendingFile::~PendingFile() {
  discard();
}

void PendingFile::discard() {
  // Unlinked first: once it is closed, another process may use the name.
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  if (stream_) std::fclose(stream_);
  stream_ = nullptr;
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
  const int lock = ::dup(::fileno(stream));  // kept until the name is given up
  errno = 0;
  // Both, even if the first fails: close reports what a network file system found out late.
  const bool flushed = std::fflush(stream) == 0;
  const int flush_error = errno;
  const bool closed = std::fclose(stream) == 0;
  int error = !flushed ? flush_error : closed ? 0 : errno;
  if (!error && ::rename(temporary_.c_str(), target_.c_str()) != 0) error = errno;
  if (!error) temporary_.clear();
  if (lock >= 0) ::close(lock);
  if (error) fail(error);
}

void PendingFile::fail(int error) {
  error_ = error;
  discard();  // a constructor that throws runs no destructor
  throw Error(ErrorKind::output,
              fmt::format("cannot write {}: {}", path_.string(), std::generic_category().message(error)));
}

}  // namespace nook
