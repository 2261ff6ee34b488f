// SPDX-License-Identifier: Apache-2.0
// Writes scene files (see scene_file.h).
#pragma once

#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The text of a scene file in scene_dir ("" for the working directory). Reading it returns scene, bit-identical except
/// for
///  - materials, which are sorted by name; empty, unprintable and duplicate names are replaced,
///  - fields without a key: those that a material's kind does not use, colours of a sky with an image,
///  - scene.path, MaterialOverride::place, and InstanceDescription::path outside scene_dir, which may be another path
///    to the same file,
///  - cameras without an up, which get the scene's.
/// Pass a scene without the additions of addSurroundings, which would be written too (see also describeRun).
std::string sceneText(const SceneDescription& scene, const std::string& scene_dir);

/// Writes sceneText to path, atomically. Throws Error kCannotWrite "PATH: reason", or kBadInput, with the place in the
/// text, for a scene that could not be read again, such as one with values out of range.
void writeSceneFile(const std::string& path, const SceneDescription& scene);

} // namespace pointrt
