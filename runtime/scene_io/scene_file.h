// SPDX-License-Identifier: Apache-2.0
// Scene files: TOML 1.0, described in docs/SCENES.md.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Of a scene file.
constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20;

/// True where path ends in .toml.
bool isSceneFile(const std::string& path);

/// Reads the scene file at path, at most 1 MiB. Files named in it are looked for beside it, and are there when this
/// returns. Throws Error kBadInput with one line: "PATH:LINE: key "light[2].radius": reason", without the key where
/// the text is no TOML, without the line where the file cannot be read. Lists count from 0.
SceneDescription readSceneFile(const std::string& path);

/// The same of text; path is for messages and for finding what it names.
SceneDescription parseScene(std::string_view text, const std::string& path);

} // namespace pointrt
