#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adaptive/error_record.hpp"
#include "device/device.hpp"
#include "film/film_part.hpp"
#include "picture/ssao_layers.hpp"
#include "plan/plan.hpp"
#include "render/repeat.hpp"

namespace nook {

/// Wall-clock seconds of the stages of a run.
struct RunSeconds {
  double load = 0, bvh = 0, compile = 0, render = 0, write = 0, total = 0;
  double ssao = 0;              ///< drawing the screen-space layers beside traced ones
  double before_first_ray = 0;  ///< of the total: until the first kernel is launched
};

/// What a run did: the EXR's metadata and `--stats`.
struct RunRecord {
  Plan plan;
  std::string scene_hash;
  std::string scene_file;
  Repeat repeat;
  std::string folder;  ///< that the picture was first written to: its meshes are looked for from there
  DeviceInfo device;   ///< name, platform_name and driver alone if only SSAO was drawn, by OpenGL
  std::vector<SsaoRecord> ssao;
  RunSeconds seconds;
  TraceCounts counts;
  std::uint64_t launches = 0;
  double device_seconds = 0;  ///< in kernels
  std::uint64_t triangles = 0;
  std::uint64_t bytes_uploaded = 0;
  std::vector<std::uint64_t> effect_rays;  ///< occlusion rays by effect, of this process
  std::uint64_t kernels_built = 0;         ///< programs, from the cache or not
  std::vector<std::string> libraries;      ///< of OpenCL, OpenGL and LLVM, mapped at the end
  bool kernels_from_cache = false;
  bool complete = true;
  std::optional<ErrorRecord> error;

  /// "nook/seed" -> "7", ...
  std::map<std::string, std::string> metadata() const;
};

/// Those of metadata() that add up when parts are joined: rays, rejected samples, seconds of rendering.
std::map<std::string, std::string> count_metadata(const TraceCounts& counts, double render_seconds);

/// Writes the record as JSON (temporary name and rename). Throws Error(output).
void write_stats(const std::filesystem::path& path, const RunRecord& record);

}  // namespace nook
