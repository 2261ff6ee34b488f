// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_cameras.h"

#include "runtime/camera.h"
#include "runtime/settings.h"

namespace pointrt {

Camera framedCamera(const StagedScene& scene, const RenderSettings& settings) {
    return frameCamera(settings.camera, scene.bounds.lo, scene.bounds.hi,
                       static_cast<double>(settings.width) / settings.height);
}

Camera stagingCamera(const StagedScene& scene, Options options) {
    options.view.clear();
    return framedCamera(scene, resolveSettings(options, scene.description));
}

} // namespace pointrt
