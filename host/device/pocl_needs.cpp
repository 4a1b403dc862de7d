#include "device/pocl_needs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

// Measured with PoCL 3.1 and 6.0 on two cores: the least that works, with something to spare.
constexpr rlim_t stack_bytes = 128 << 10;
constexpr std::size_t address_bytes = std::size_t(640) << 20;
constexpr int open_files = 10;

bool names_pocl(std::string_view text) {
  return text.find("pocl") != std::string_view::npos;
}

// The system's loader reads a folder of .icd files, each with the name of a driver's library; the variables
// may also name one such file or library.
bool pocl_is_registered() {
  fs::path vendors = "/etc/OpenCL/vendors";
  for (const char* variable : {"OPENCL_VENDOR_PATH", "OCL_ICD_VENDORS"})
    if (const char* value = std::getenv(variable); value && *value) vendors = value;
  std::error_code failed;
  std::vector<fs::path> files = {vendors};
  if (fs::is_directory(vendors, failed)) {
    files.clear();
    for (fs::directory_iterator entry(vendors, failed), end; !failed && entry != end; entry.increment(failed))
      files.push_back(entry->path());
  }
  return std::any_of(files.begin(), files.end(), [](const fs::path& file) {
    std::string library;
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored)) std::getline(std::ifstream(file), library);
    return names_pocl(library) || names_pocl(file.filename().string());
  });
}

[[noreturn]] void wanting(const std::string& what) {
  throw Error(ErrorKind::device, "PoCL cannot work here: " + what);
}

// The soft limit becomes `wanted` where the hard one allows it; what it is then.
rlim_t raised(int resource, rlim_t wanted) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return RLIM_INFINITY;
  if (limit.rlim_cur >= wanted) return limit.rlim_cur;
  limit.rlim_cur = std::min(wanted, limit.rlim_max);
  setrlimit(resource, &limit);
  return limit.rlim_cur;
}

void check_stack() {
  const rlim_t now = raised(RLIMIT_STACK, rlim_t(8) << 20);
  if (now < stack_bytes)
    wanting(fmt::format("its compiler needs a stack of {} KiB, the limit is {} (ulimit -s)",
                        stack_bytes >> 10, now >> 10));
}

void check_address_space() {
  void* room = mmap(nullptr, address_bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED)
    wanting(fmt::format("it needs {} MiB of address space, the limit leaves less (ulimit -v)",
                        address_bytes >> 20));
  munmap(room, address_bytes);
}

void check_open_files() {
  raised(RLIMIT_NOFILE, 256);
  std::vector<int> files;
  bool enough = true;
  while (enough && files.size() < open_files) {
    files.push_back(open("/", O_RDONLY | O_CLOEXEC));
    enough = files.back() >= 0;
  }
  for (const int file : files)
    if (file >= 0) close(file);
  if (!enough)
    wanting(
        fmt::format("it needs {} open files, the limit leaves {} (ulimit -n)", open_files, files.size() - 1));
}

void* wait_for(void* gate) {
  pthread_mutex_lock(static_cast<pthread_mutex_t*>(gate));
  pthread_mutex_unlock(static_cast<pthread_mutex_t*>(gate));
  return nullptr;
}

// Threads that can run at once, at most `asked`; the limits are of a user's or a control group's processes,
// which only a trial tells.
unsigned threads_possible(unsigned asked) {
  pthread_mutex_t gate = PTHREAD_MUTEX_INITIALIZER;
  pthread_attr_t small;
  pthread_attr_init(&small);
  pthread_attr_setstacksize(&small, 64 << 10);
  std::vector<pthread_t> started(asked);
  unsigned count = 0;
  pthread_mutex_lock(&gate);
  while (count < asked && pthread_create(&started[count], &small, wait_for, &gate) == 0) ++count;
  pthread_mutex_unlock(&gate);
  for (unsigned i = 0; i < count; ++i) pthread_join(started[i], nullptr);
  pthread_attr_destroy(&small);
  return count;
}

// PoCL's own, those of nook that wait or build the tree meanwhile, and the linker's process.
void check_threads(unsigned threads) {
  const unsigned needed = 2 * threads + 1;
  const unsigned possible = threads_possible(needed);
  if (possible < needed)
    wanting(
        fmt::format("{} threads need {} processes of the user's, the limit leaves {} (ulimit -u, or the "
                    "control group's pids.max); --threads asks for fewer",
                    threads, needed, possible));
}

bool has_linker(std::string_view path) {
  while (!path.empty()) {
    const std::string_view folder = path.substr(0, path.find(':'));
    if (!folder.empty() && access((fs::path(folder) / "ld").c_str(), X_OK) == 0) return true;
    path.remove_prefix(std::min(path.size(), folder.size() + 1));
  }
  return false;
}

// Clang, within PoCL, looks for `ld` in PATH alone.
void check_linker() {
  const char* set = std::getenv("PATH");
  const std::string path = set ? set : "";
  const std::string_view system = "/usr/local/bin:/usr/bin:/bin";
  if (has_linker(path)) return;
  if (!has_linker(system))
    wanting(
        "its compiler needs the linker ld, which is in no folder of PATH; on Debian: apt-get install "
        "binutils");
  setenv("PATH", (path.empty() ? std::string(system) : path + ':' + std::string(system)).c_str(), 1);
}

// Without it PoCL 3.1 finds no memory, and aborts.
void check_topology() {
  if (access("/sys/devices/system/cpu", R_OK) != 0 && access("/sys/bus/cpu/devices", R_OK) != 0)
    wanting("it reads the processors' topology in /sys/devices/system/cpu, which is not there; mount /sys");
}

}  // namespace

void check_what_pocl_needs(unsigned threads) {
  if (!pocl_is_registered()) return;
  check_topology();
  check_stack();
  check_address_space();
  check_open_files();
  check_threads(threads);
  check_linker();
}

}  // namespace nook
