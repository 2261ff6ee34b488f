// SPDX-License-Identifier: Apache-2.0
// What rays tell of the tiles that a picture needs: those that no camera sees, but mirrors and shining surfaces show.
#pragma once

#include <vector>

#include "runtime/render/band_tracer.h"

namespace pointrt {

/// Traces small pictures of scene, the tracer's, and marks those of its sets' tiles as wanted that are met by a
/// hundredth as many scattered and mirrored rays as a picture has pixels, or more. True where any of them was not
/// marked before and has finer ones below it. The tracer must have room for the settings' pictures; its film is lost.
bool markTilesMet(Device& device, BandTracer& tracer, DeviceScene& scene, const RenderSettings& settings,
                  const std::vector<Camera>& cameras);

} // namespace pointrt
