#include "device/pocl_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "device/program_cache.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

// A process holds a lock on NAME.lock as long as it uses the folder NAME; a lock that can be taken is a dead
// process's.
constexpr const char* lock_suffix = ".lock";

fs::path folder_of(const fs::path& lock) {
  return fs::path(lock).replace_extension();
}

// The lock goes last, and only if nothing is left: a folder without one would stay for ever.
void remove_folder(const fs::path& lock) {
  std::error_code failed;
  fs::remove_all(folder_of(lock), failed);
  if (!failed) fs::remove(lock, failed);
}

void remove_what_was_left(const fs::path& folder) {
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    const fs::path lock = entry->path();
    if (lock.extension() != lock_suffix) continue;
    const int file = open(lock.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) continue;
    if (flock(file, LOCK_EX | LOCK_NB) == 0) remove_folder(lock);
    close(file);
  }
}

// An open, locked file of a name of its own, or -1 and errno. It stays open until the process ends.
int make_lock(const fs::path& folder, fs::path& lock) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    std::string name = (folder / "run-XXXXXX").string() + lock_suffix;
    const int file = mkostemps(name.data(), int(std::string(lock_suffix).size()), O_CLOEXEC);
    if (file < 0) return -1;
    lock = name;
    struct stat status;
    const bool locked = flock(file, LOCK_EX | LOCK_NB) == 0;
    const int error = errno;
    // Another process may have taken it for a dead one's before it was locked.
    if (locked && fstat(file, &status) == 0 && status.st_nlink == 1) return file;
    close(file);
    if (!locked && error != EWOULDBLOCK) {  // no locks here, so nobody else's either
      unlink(name.c_str());
      errno = error;
      return -1;
    }
  }
  return -1;
}

bool is_full(int error) {
  return error == ENOSPC || error == EDQUOT || error == EFBIG;
}

// PoCL ends the process where it cannot write its files, some hundred kilobytes each. The error that says so,
// or 0.
int error_of_room_in(const fs::path& folder) {
  constexpr int files = 4;
  constexpr off_t bytes = 1 << 20;
  int error = 0;
  for (int i = 0; i < files && !is_full(error); ++i) {
    const int file = open((folder / std::to_string(i)).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    error = file < 0 ? errno : posix_fallocate(file, 0, bytes);
    if (file >= 0) close(file);
  }
  std::error_code ignored;
  for (int i = 0; i < files; ++i) fs::remove(folder / std::to_string(i), ignored);
  return is_full(error) ? error : 0;
}

std::string problem;
fs::path lock_of_this_process;
pid_t process_of_lock;

// In a folder of its own choice PoCL would meet the same disk, and trust what it finds there.
void note_if_full(const fs::path& folder, int error) {
  if (is_full(error))
    problem = folder.string() + ": " + std::strerror(error) + ": PoCL has no room for its files there";
}

}  // namespace

void give_pocl_its_own_folder() {
  const char* chosen = std::getenv("POCL_CACHE_DIR");
  const fs::path cache = program_cache_dir();
  if ((chosen && *chosen) || cache.empty()) return;
  const fs::path folder = cache / "pocl";
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return note_if_full(folder, failed.value());
  remove_what_was_left(folder);
  fs::path lock;
  if (make_lock(folder, lock) < 0) return note_if_full(folder, errno);
  if (!fs::create_directory(folder_of(lock), failed)) {
    remove_folder(lock);
    return note_if_full(folder, failed.value());
  }
  note_if_full(folder, error_of_room_in(folder_of(lock)));
  lock_of_this_process = lock;
  process_of_lock = getpid();
  // PoCL is loaded later, so its own exit handlers run before this one.
  std::atexit([] {
    if (getpid() == process_of_lock) remove_folder(lock_of_this_process);
  });
  setenv("POCL_CACHE_DIR", folder_of(lock).c_str(), 1);
}

const std::string& problem_of_pocl_folder() {
  return problem;
}

}  // namespace nook
