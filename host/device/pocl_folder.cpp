#include "device/pocl_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "base/threads.hpp"
#include "device/pocl_needs.hpp"
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
    struct stat status = {};
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

// Longer names do not fit PoCL's buffers once it has put its own behind.
constexpr std::size_t longest_name = 800;

// PoCL ends the process where it cannot write its files (some hundred kilobytes each, in folders of their
// own) or map what it has compiled. The error that says so, or 0.
int error_of_use(const fs::path& folder) {
  constexpr int files = 4;
  constexpr off_t bytes = 1 << 20;
  if (folder.string().size() > longest_name) return ENAMETOOLONG;
  const fs::path inside = folder / "nook-trial";
  int error = mkdir(inside.c_str(), 0777) == 0 ? 0 : errno;
  for (int i = 0; i < files && !error; ++i) {
    const int file = open((inside / std::to_string(i)).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    error = file < 0 ? errno : posix_fallocate(file, 0, bytes);
    if (error == EOPNOTSUPP) error = 0;
    if (!error) {
      void* code = mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE, file, 0);
      if (code == MAP_FAILED)
        error = errno == EPERM || errno == EACCES ? ENOEXEC : errno;
      else
        munmap(code, 4096);
    }
    if (file >= 0) close(file);
  }
  std::error_code ignored;
  fs::remove_all(inside, ignored);
  return error;
}

std::string reason_of(int error) {
  return error == ENOEXEC ? "no program may be run from there (mounted noexec?)" : std::strerror(error);
}

std::optional<Error> problem;
fs::path lock_of_this_process;
pid_t process_of_lock;
// Says to processes started from here that POCL_CACHE_DIR is not the user's choice but this process's folder.
constexpr const char* folder_of_nook = "NOOK_POCL_FOLDER";

// A run's own folder in `parent`, which is made if need be. Its errno, or 0.
int make_folder_in(const fs::path& parent) {
  std::error_code failed;
  fs::create_directories(parent, failed);
  if (failed) return failed.value();
  remove_what_was_left(parent);
  fs::path lock;
  const int lock_file = make_lock(parent, lock);
  if (lock_file < 0) return errno;
  const fs::path folder = folder_of(lock);
  int error = mkdir(folder.c_str(), 0700) == 0 && chmod(folder.c_str(), 0700) == 0 ? 0 : errno;
  if (!error) error = error_of_use(folder);
  if (error) {
    remove_folder(lock);
    close(lock_file);
    return error;
  }
  lock_of_this_process = lock;
  process_of_lock = getpid();
  // PoCL is loaded later, so its own exit handlers run before this one.
  std::atexit([] {
    if (getpid() == process_of_lock) remove_folder(lock_of_this_process);
  });
  setenv("POCL_CACHE_DIR", folder.c_str(), 1);
  setenv(folder_of_nook, folder.c_str(), 1);
  return 0;
}

// In `temporary`, where others may write too: this user's alone. Its errno, or 0.
int make_private_folder_in(const fs::path& temporary) {
  const fs::path folder = temporary / ("nook-" + std::to_string(geteuid()));
  if (mkdir(folder.c_str(), 0700) == 0)
    chmod(folder.c_str(), 0700);  // whatever the umask
  else if (errno != EEXIST)
    return errno;
  struct stat status = {};
  if (lstat(folder.c_str(), &status) != 0) return errno;
  const bool ours = S_ISDIR(status.st_mode) && status.st_uid == geteuid() && (status.st_mode & 0777) == 0700;
  return ours ? make_folder_in(folder) : EACCES;
}

std::string text_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

void check_chosen(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  const int error = failed ? failed.value() : error_of_use(folder);
  // A full disk does no harm where all that PoCL needs is there already.
  if (error && !is_full(error))
    problem = Error(ErrorKind::device, "POCL_CACHE_DIR: " + folder.string() + ": " + reason_of(error));
}

void make_folder() {
  std::string tried;
  // In another folder PoCL would meet the same full disk more often than not: only other errors go on.
  const auto settled = [&](const fs::path& folder, int error) {
    if (is_full(error))
      problem = Error(ErrorKind::output, Place{folder.string()},
                      std::string(std::strerror(error)) + ": PoCL has no room for its files there");
    else if (error)
      tried += "; " + folder.string() + ": " + reason_of(error);
    return error == 0 || is_full(error);
  };
  if (const fs::path cache = program_cache_dir(); !cache.empty())
    if (settled(cache / "pocl", make_folder_in(cache / "pocl"))) return;
  for (const std::string& temporary : {text_of("TMPDIR"), std::string("/tmp"), std::string("/var/tmp")})
    if (!temporary.empty() && settled(temporary, make_private_folder_in(temporary))) return;
  problem = Error(ErrorKind::device, "PoCL has no folder for its files, NOOK_CACHE_DIR names one" + tried);
}

}  // namespace

void prepare_for_pocl() {
  // One that throws is not done: the next call throws again.
  static const bool done = [] {
    check_what_pocl_needs(threads_to_use());
    const std::string chosen = text_of("POCL_CACHE_DIR");
    if (!chosen.empty() && chosen != text_of(folder_of_nook))
      check_chosen(chosen);
    else
      make_folder();
    return true;
  }();
  (void)done;
}

void reuse_code_of_single_items() {
  if (lock_of_this_process.empty()) return;  // the user's folder is the user's
  std::error_code failed;
  std::vector<fs::path> of_one;  // PROGRAM/KERNEL/1-1-1-goffs0
  for (fs::recursive_directory_iterator entry(folder_of(lock_of_this_process), failed), end;
       !failed && entry != end; entry.increment(failed))
    if (entry->is_directory(failed) && entry->path().filename() == "1-1-1-goffs0")
      of_one.push_back(entry->path());
  for (const fs::path& code : of_one)
    if (const fs::path any = code.parent_path() / "0-0-0"; !fs::exists(any, failed)) {
      fs::copy(code, any, fs::copy_options::recursive | fs::copy_options::create_hard_links, failed);
      if (failed) fs::remove_all(any, failed);
    }
}

const std::optional<Error>& problem_of_pocl_folder() {
  return problem;
}

}  // namespace nook
