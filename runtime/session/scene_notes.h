// SPDX-License-Identifier: Apache-2.0
// Decisions that the viewer made about a scene, and the options to override them.
#pragma once

#include <string>
#include <vector>

#include "runtime/render/loaded_scene.h"

namespace pointrt {

/// A line for each decision, without the tool's name: the up direction if the bake or the viewer guessed it, and the
/// colours of scans without colours.
/// @param up_is_given by the command line or the scene file
std::vector<std::string> sceneNotes(const LoadedScene& loaded, bool up_is_given);

} // namespace pointrt
