// SPDX-License-Identifier: Apache-2.0
// The cameras that a run begins with.
#pragma once

#include "runtime/device_scene/device_scene.h"
#include "runtime/scene/render_settings.h"
#include "runtime/session/options.h"

namespace pointrt {

/// The settings' camera for the scene's bounds and the picture's shape. Throws Error as frameCamera does.
Camera framedCamera(const DeviceScene& scene, const RenderSettings& settings);

/// The one that surroundings are put up for: not a view's, so that views differ in the camera alone. scene has none
/// yet.
Camera stagingCamera(const DeviceScene& scene, Options options);

} // namespace pointrt
