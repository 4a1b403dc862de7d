#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.hpp"

namespace nook {

/// Reads a scene file: TinyRender's TOML and nook's additions (docs/scene-format.md).
/// Throws Error(scene) with one line "<file>:<row>:<column>: ..." for a syntax error, an unknown table, key
/// or value (with the nearest known one), a wrong type, or a value out of its range.
Scene load_scene(const std::filesystem::path& path);

/// The same of a text; `file`: where it is from, for messages and for the folder that meshes are relative to.
Scene parse_scene(const std::string& text, const std::filesystem::path& file);

/// A scene for a bare mesh: a camera that frames it, AO with 16 camera rays a pixel.
Scene scene_of_mesh(const std::filesystem::path& mesh_file);

/// The same for a picture to show: on a ground, occluded at any distance, with alpha in its preview where
/// there is nothing.
Scene picture_of_mesh(const std::filesystem::path& mesh_file);

/// Checks what several keys decide together, after command-line overrides: eye = at, up parallel to the view,
/// crop outside the film. Throws Error(scene).
void validate(const Scene& scene);

}  // namespace nook
