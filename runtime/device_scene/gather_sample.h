// SPDX-License-Identifier: Apache-2.0
// A few splats of a scene's scans, without reading them all.
#pragma once

#include "runtime/device_scene/device_scene.h"
#include "runtime/scene/scene_sample.h"

namespace pointrt {

/// Splats at even steps along the curve on which files have them, as many of each instance as it has of all; where
/// scanners stood, and where files have their zero; all as it stands in the scene. Of a set these are original splats,
/// so that it is seen as one file of them is; of more than 4 million, merged ones. A few hundredths of a second,
/// whatever the scene's size, and more where a set's tiles come from a disk.
SceneSample gatherSample(const DeviceScene& scene);

} // namespace pointrt
