#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <cerrno>
#include <ctime>
#include <memory>

#include "app/commands/delivery.hpp"
#include "base/error.hpp"
#include "base/pending_file.hpp"

namespace nook {
namespace {

struct FreeArchive {
  void operator()(archive* a) const { archive_write_free(a); }
};
struct FreeEntry {
  void operator()(archive_entry* e) const { archive_entry_free(e); }
};

// No exception may cross libarchive's frames.
la_ssize_t append(archive* zip, void* file, const void* data, std::size_t bytes) {
  try {
    static_cast<PendingFile*>(file)->write(data, bytes);
    return la_ssize_t(bytes);
  } catch (const Error& e) {
    archive_set_error(zip, EIO, "%s", e.what());
    return -1;
  }
}

}  // namespace

void write_zip(const std::filesystem::path& path, const std::vector<ArchiveEntry>& entries) {
  constexpr std::time_t first_zip_time =
      315532800 + 43200;  // 1980-01-01 12:00 UTC: the same day in every time zone
  PendingFile file(path);
  const std::unique_ptr<archive, FreeArchive> zip(archive_write_new());
  auto check = [&](int code) {
    if (code != ARCHIVE_OK) throw Error(ErrorKind::output, archive_error_string(zip.get()));
  };
  check(archive_write_set_format_zip(zip.get()));
  check(archive_write_set_bytes_in_last_block(zip.get(), 1));
  check(archive_write_open(zip.get(), &file, nullptr, append, nullptr));
  for (const ArchiveEntry& item : entries) {
    const bool folder = item.name.back() == '/';
    const std::unique_ptr<archive_entry, FreeEntry> entry(archive_entry_new());
    archive_entry_set_pathname(entry.get(), item.name.c_str());
    archive_entry_set_filetype(entry.get(), folder ? AE_IFDIR : AE_IFREG);
    archive_entry_set_perm(entry.get(), folder ? 0755 : 0644);
    archive_entry_set_mtime(entry.get(), first_zip_time, 0);
    archive_entry_set_size(entry.get(), la_int64_t(item.bytes.size()));
    check(archive_write_header(zip.get(), entry.get()));
    if (!folder &&
        archive_write_data(zip.get(), item.bytes.data(), item.bytes.size()) != la_ssize_t(item.bytes.size()))
      check(ARCHIVE_FATAL);
  }
  check(archive_write_close(zip.get()));
  file.commit();
}

}  // namespace nook
