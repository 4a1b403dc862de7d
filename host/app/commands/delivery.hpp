#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nook {

/// One picture of a delivery.
struct DeliveryEntry {
  std::string title;            ///< what it shows, for people
  std::string render;           ///< its place in the archive: "offline/NAME.exr" or "realtime/NAME.exr"
  std::filesystem::path scene;  ///< the scene it is rendered from
};

/// An assignment's delivery set, as its config.json describes it.
struct Delivery {
  std::string student;
  std::uint64_t id = 0, course = 0, assignment = 0;
  std::vector<DeliveryEntry> entries;
  std::string config;  ///< the text of config.json for the archive, with the student's name in it
};

/// Reads and checks a config.json; `student`, if not empty, replaces the name in it. The scene of an entry
/// offline/NAME.exr is NAME.toml or NAME_offline.toml in the first of `scene_folders` that has one, and its
/// realtime key must agree with the folder. Throws Error(scene) with one line that names the file and the
/// entry.
Delivery read_delivery(const std::filesystem::path& config, const std::string& student,
                       const std::vector<std::filesystem::path>& scene_folders);

/// A file or folder of an archive: "offline/a.exr" and what it holds; a name that ends in '/' is an empty
/// folder.
struct ArchiveEntry {
  std::string name;
  std::string bytes;
};

/// What an archive packs of a file. Throws Error(scene) naming it.
std::string packed_bytes(const std::filesystem::path& file);

/// Throws Error(scene), which names `path` and where it leads, unless it is in `folder` once all symbolic
/// links are followed.
void require_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Appends the files of `folder`, in the order of their names, as entries PREFIX + name; PREFIX itself if
/// there are none. A symbolic link to what is in the folder is packed under its own name, as what it leads
/// to; one that leads out of it, nowhere, or to a folder that it is in is refused, as require_within() does.
/// What is neither file nor folder is left out, with a warning on stderr.
void add_folder(const std::filesystem::path& folder, const std::string& prefix,
                std::vector<ArchiveEntry>& archive);

/// Writes a ZIP archive (temporary name and rename). Equal entries give equal bytes: every entry has the time
/// 1980-01-01. Throws Error(output).
void write_zip(const std::filesystem::path& path, const std::vector<ArchiveEntry>& entries);

}  // namespace nook
