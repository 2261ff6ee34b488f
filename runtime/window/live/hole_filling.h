// SPDX-License-Identifier: Apache-2.0
// Filling of pixels that no cached point projects to.
#pragma once

#include "runtime/window/live/render_cache.h"

namespace pointrt {

/// Gives each empty pixel a colour: the mean of its farthest neighbours, since disocclusions reveal background. Gaps
/// within one surface get that surface's colour, and pixels far from all points the mean of the surrounding tiles. The
/// pixels still count as empty. Returns the number of gaps within a surface.
std::uint32_t fillHoles(RenderCache& cache);

/// Resamples the cache to one point per pixel centre, for when gaps have become too many. Gaps within a surface get
/// interpolated points.
void resamplePoints(RenderCache& cache, const ViewProjection& view);

} // namespace pointrt
