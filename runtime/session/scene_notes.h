// SPDX-License-Identifier: Apache-2.0
// What the viewer decided by itself about a scene, and the options against it.
#pragma once

#include <string>
#include <vector>

#include "runtime/render/loaded_scene.h"

namespace pointrt {

/// A line for each decision, without the tool's name: the up direction if it is a guess of the bake or of the viewer,
/// and colours of scans without colour.
/// @param up_is_given by the command line or the scene file
std::vector<std::string> sceneNotes(const LoadedScene& loaded, bool up_is_given);

} // namespace pointrt
