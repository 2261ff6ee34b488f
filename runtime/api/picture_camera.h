// SPDX-License-Identifier: Apache-2.0
// A caller's camera as one of a loaded scene.
#pragma once

#include "pointrt/render.hpp"
#include "runtime/render/loaded_scene.h"

namespace pointrt {

/// request: what loaded was loaded with, whose camera says what LookAt does not.
/// Throws Error kBadUsage for what is no camera, or stands more than 10000 radii of the scene away.
Camera sceneCamera(const PictureCamera& camera, const LoadedScene& loaded, const LoadRequest& request, PixelSize size);

} // namespace pointrt
