// SPDX-License-Identifier: Apache-2.0
// Tile selection feedback: finds tiles outside every view that secondary rays hit.
#pragma once

#include <vector>

#include "runtime/render/band_tracer.h"

namespace pointrt {

/// Traces low-resolution pictures of the tracer's scene and marks the tiles that are hit by at least 1% as many
/// secondary rays as the pictures have pixels. True if a newly marked tile has children. The tracer must have room for
/// pictures of the settings' size; its film is lost.
bool markTilesHit(Device& device, BandTracer& tracer, DeviceScene& scene, const RenderSettings& settings,
                  const std::vector<Camera>& cameras);

} // namespace pointrt
