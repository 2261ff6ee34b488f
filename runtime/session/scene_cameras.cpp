// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/scene_cameras.h"

#include "runtime/scene/camera.h"
#include "runtime/session/settings.h"

namespace pointrt {

Camera framedCamera(const DeviceScene& scene, const RenderSettings& settings) {
    return frameCamera(settings.camera, scene.bounds.lo, scene.bounds.hi,
                       static_cast<double>(settings.width) / settings.height);
}

Camera stagingCamera(const DeviceScene& scene, Options options) {
    options.view.clear();
    return framedCamera(scene, resolveSettings(options, scene.description));
}

} // namespace pointrt
