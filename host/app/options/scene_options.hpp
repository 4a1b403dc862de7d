#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/device.hpp"
#include "scene/key.hpp"
#include "scene/scene.hpp"

namespace nook {

/// The command-line options that override a scene. Precedence: flag, environment (NOOK_SPP for --spp), scene,
/// default.
struct SceneOptions {
  std::filesystem::path scene;
  std::map<std::string, std::string> texts;  ///< what was given for a key's flag; empty: nothing
  std::optional<std::string> size;
  std::vector<int> crop;
  bool of_pictures = true;  ///< a bare mesh is loaded as its first picture; else as the mesh alone

  /// Adds SCENE and the options to a subcommand: those of keys that effects of `kinds` read, less `left_out`
  /// ("--spp"): what a command does not read is neither in its help nor taken.
  void add_to(CLI::App& command, EffectKinds kinds = all_kinds,
              const std::set<std::string_view>& left_out = {});
  /// Adds the preview's.
  void add_background_to(CLI::App& command);
  /// Loads the scene (TOML, a bare mesh, a picture), lets `choose` change it, applies the overrides,
  /// validates. Throws Error(usage) or Error(scene).
  Scene load(const std::function<void(Scene&)>& choose = {}) const;
  /// Sets what the flags say of these keys.
  template <class Owner>
  void apply(std::span<const Key<Owner>> keys, Owner& owner) const;
  /// Sets what the flags say of an effect of its type. Throws Error(usage) for settings that exclude one
  /// another.
  void apply(Effect& effect) const;
  /// Whether the key's flag, or its variable, was given.
  bool has(const std::string& flag) const;
  /// The keys whose flags or variables were given; each says which effects read it.
  std::vector<const KeyInfo*> given() const;
  /// Throws Error(usage) for the first flag that no effect of the scene reads. A variable may be meant for
  /// all scenes of a folder; a flag is meant for this one.
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

}  // namespace nook
