#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "device/device.hpp"
#include "scene/scene.hpp"

namespace nook {

/// The command-line options that override a scene. Precedence: flag, environment (NOOK_SPP for --spp), scene,
/// default.
struct SceneOptions {
  std::filesystem::path scene;
  std::optional<std::uint32_t> spp, directions, seed;
  std::optional<std::string> sampling, sampler, max_distance, size, method, quality, radius;
  std::optional<float> exponent;
  std::vector<int> crop;

  /// Adds SCENE and the options to a subcommand.
  void add_to(CLI::App& command);
  /// Loads the scene (TOML, or a bare OBJ), applies the overrides, validates. Throws Error(usage) or
  /// Error(scene).
  Scene load() const;
  /// Throws Error(usage) for the first flag that no effect of the scene reads.
  void check_applicable(const Scene& loaded) const;
};

/// Throws Error(output) if `output` is the scene file or one of its meshes: a slip of the hand that would
/// cost the user's work.
void keep_inputs(const Scene& scene, const std::filesystem::path& output);

/// --device and --threads.
struct DeviceOptions {
  std::string selector;
  unsigned threads = 0;

  void add_to(CLI::App& command);
  /// What must be settled before a device is opened, while no other thread runs: numbers of threads, and,
  /// for `opencl`, environment variables for PoCL.
  void prepare(bool opencl = true) const;
  Device open() const;  ///< prepares, too
};

/// The scene as TOML, every key with its value: what --print-config prints and the scene hash covers.
std::string to_toml(const Scene& scene);

/// 128 bits over to_toml() less the file names and how long to render. 32 hexadecimal digits.
std::string scene_hash(const Scene& scene);

}  // namespace nook
