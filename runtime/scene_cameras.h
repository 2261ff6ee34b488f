// SPDX-License-Identifier: Apache-2.0
// The cameras that a run begins with.
#pragma once

#include "runtime/options.h"
#include "runtime/render.h"
#include "runtime/staged_scene.h"

namespace pointrt {

/// The settings' camera for the scene's bounds and the picture's shape. Throws Error as frameCamera does.
Camera framedCamera(const StagedScene& scene, const RenderSettings& settings);

/// The one that surroundings are put up for: not a view's, so that views differ in the camera alone. scene has none
/// yet.
Camera stagingCamera(const StagedScene& scene, Options options);

} // namespace pointrt
