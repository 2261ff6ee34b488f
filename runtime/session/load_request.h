// SPDX-License-Identifier: Apache-2.0
// The request to load a scene with the options of the command line.
#pragma once

#include "runtime/render/loaded_scene.h"
#include "runtime/session/options.h"

namespace pointrt {

/// The request for scene, from describeScene. Default surroundings are placed for the camera without options.view, so
/// that views differ only in the camera. Throws Error as resolveSettings does.
LoadRequest loadRequest(const Options& options, SceneDescription scene);

} // namespace pointrt
