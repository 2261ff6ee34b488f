// SPDX-License-Identifier: Apache-2.0
// What the command line and a scene say, as what is to be loaded.
#pragma once

#include "runtime/render/loaded_scene.h"
#include "runtime/session/options.h"

namespace pointrt {

/// For scene, which describeScene has read. Surroundings are put up for the camera without options.view, so that views
/// differ in the camera alone. Throws Error as resolveSettings does.
LoadRequest loadRequest(const Options& options, SceneDescription scene);

} // namespace pointrt
