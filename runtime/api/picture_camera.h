// SPDX-License-Identifier: Apache-2.0
// Converts a caller's camera for a loaded scene.
#pragma once

#include "pointrt/render.hpp"
#include "runtime/render/loaded_scene.h"

namespace pointrt {

/// request: the one that `loaded` was loaded for; its camera supplies what a LookAt leaves out. Throws Error kBadUsage
/// for invalid cameras and those more than 10000 scene radii away.
Camera sceneCamera(const PictureCamera& camera, const LoadedScene& loaded, const LoadRequest& request, PixelSize size);

} // namespace pointrt
