// What of a folder is packed: its own files alone, whatever its links say.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "app/commands/delivery.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void reject(const fs::path& path, const std::string& what) {
  throw Error(ErrorKind::scene, Place{path.string()}, what);
}

fs::path resolved(const fs::path& path) {
  std::error_code failed;
  const fs::path end = fs::canonical(path, failed);
  if (!failed) return end;
  std::error_code ignored;
  reject(path,
         fs::is_symlink(fs::symlink_status(path, ignored)) ? "a link that leads nowhere" : failed.message());
}

bool contains(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

std::vector<fs::path> sorted_entries(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    entries.push_back(entry->path());
  if (failed) reject(folder, failed.message());
  std::sort(entries.begin(), entries.end());
  return entries;
}

class Packer {
 public:
  Packer(const fs::path& folder, std::vector<ArchiveEntry>& archive)
      : root_(resolved(folder)), archive_(archive) {}

  void add(const fs::path& folder, const std::string& prefix) {
    const fs::path end = resolved(folder);
    if (std::find(open_.begin(), open_.end(), end) != open_.end())
      reject(folder, "a link to a folder that it is in");
    open_.push_back(end);
    for (const fs::path& entry : sorted_entries(folder)) {
      const fs::path target = resolved(entry);
      if (!contains(root_, target))
        reject(entry,
               fmt::format("leads out of the folder, to {}; only what is in it is packed", target.string()));
      const std::string name = prefix + entry.filename().string();
      std::error_code failed;
      if (fs::is_directory(target, failed))
        add(entry, name + '/');
      else if (fs::is_regular_file(target, failed))
        archive_.push_back({name, packed_bytes(entry)});
      else
        to_stderr("warning: {}: left out, neither a file nor a folder\n", entry.string());
    }
    open_.pop_back();
  }

 private:
  fs::path root_;
  std::vector<ArchiveEntry>& archive_;
  std::vector<fs::path> open_;  ///< the folders that add() is in
};

}  // namespace

std::string packed_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in && bytes.empty()) reject(file, "cannot be read");
  return bytes;
}

void require_within(const fs::path& path, const fs::path& folder) {
  const fs::path target = resolved(path);
  if (!contains(resolved(folder), target))
    reject(path, fmt::format("leads out of {}, to {}", folder.string(), target.string()));
}

void add_folder(const fs::path& folder, const std::string& prefix, std::vector<ArchiveEntry>& archive) {
  const std::size_t before = archive.size();
  Packer(folder, archive).add(folder, prefix);
  if (archive.size() == before) archive.push_back({prefix, ""});
}

}  // namespace nook
