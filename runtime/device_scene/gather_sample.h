// SPDX-License-Identifier: Apache-2.0
// A sample of the splats of a scene's scans, without reading all of them.
#pragma once

#include "runtime/device_scene/device_scene.h"
#include "runtime/scene/scene_sample.h"

namespace pointrt {

/// Samples every n-th splat along the space-filling curve of the files, so that each instance counts in proportion to
/// its splats; adds the positions of scanners and the origins of files. Everything is in scene coordinates. Sets of up
/// to 4 million splats are sampled from their original splats, so that they are framed like single files, larger ones
/// from merged splats. Takes a few hundredths of a second whatever the size of the scene, more if tiles must be read
/// from disk.
SceneSample gatherSample(const DeviceScene& scene);

/// The same for the part that the scene's clips keep. If few splats of the sample remain, reads more, up to 4 million.
SceneSample gatherKeptSample(const DeviceScene& scene);

} // namespace pointrt
