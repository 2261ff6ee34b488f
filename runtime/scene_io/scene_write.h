// SPDX-License-Identifier: Apache-2.0
// Scene files (scene_file.h), the other way round.
#pragma once

#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// scene as a scene file that lies in scene_dir ("" for the working directory). Read again it is scene, to the bit, but
/// for
///  - materials, which come back in the order of their names; those whose name is empty, not printable or another's
///    get a new one,
///  - what has no key: of materials what their kind does not use, colours of a sky with an image,
///  - scene.path, MaterialOverride::place, and an InstanceDescription::path outside of scene_dir, which leads to the
///    same file by another way,
///  - a camera without an up, which stands as the scene does.
/// What addSurroundings has added is in it like all else: give it a scene from before that (see also describeRun).
std::string sceneText(const SceneDescription& scene, const std::string& scene_dir);

/// Writes sceneText to path, whole or not at all. Throws Error kCannotWrite "PATH: reason"; kBadInput, with the place
/// in the text, for a scene that could not be read again, such as one with values out of range.
void writeSceneFile(const std::string& path, const SceneDescription& scene);

} // namespace pointrt
