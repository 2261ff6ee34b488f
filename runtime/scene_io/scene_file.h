// SPDX-License-Identifier: Apache-2.0
// Scene files: TOML 1.0, described in docs/SCENES.md.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Largest size of a scene file.
constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20;

/// True if path ends in .toml.
bool isSceneFile(const std::string& path);

/// True if path is a scene file or a tile set, that is, a scene other than a .pro.
bool isSceneOrSet(const std::string& path);

/// Reads the scene file at path, at most 1 MiB. Files named in it are relative to its folder, and must exist. Throws
/// Error kBadInput with one line: "PATH:LINE: key "light[2].radius": reason", without the key for invalid TOML, without
/// the line if the file cannot be read. Lists count from 0.
SceneDescription readSceneFile(const std::string& path);

/// The same for the text of a file; path is for messages and to find the files that it names.
SceneDescription parseScene(std::string_view text, const std::string& path);

} // namespace pointrt
