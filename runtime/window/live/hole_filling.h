// SPDX-License-Identifier: Apache-2.0
// What pixels show in which no point lies.
#pragma once

#include "runtime/window/live/render_cache.h"

namespace pointrt {

/// A hole shows the mean of the farthest points beside it, for that is what comes to light behind edges; between points
/// of one surface that is the surface. Far from all points it shows the means of the tiles around. It stays a hole.
/// Returns how many lie between points of one surface.
std::uint32_t fillHoles(RenderCache& cache);

/// Makes the picture's points one a pixel again, in its middle, where too many of its pixels lie between them: holes on
/// a surface get points of it, by guess.
void resamplePoints(RenderCache& cache, const ViewProjection& view);

} // namespace pointrt
