// SPDX-License-Identifier: Apache-2.0
// The result of rendering: plain structs between the tracer and the image files.
#pragma once

#include <cstdint>
#include <vector>

#include "shaders/shared/film_parts.h"

namespace pointrt {

/// Rays counted on the device while tracing.
struct RayCounts {
    std::uint64_t primary = 0, shadow = 0, secondary = 0;
    std::uint64_t cut = 0; ///< rays among these that ended before all Gaussians along them were tested
};

#define POINTRT_FILM_ARRAY(array, Value, channels, group, nothing, source, view) std::vector<Value> array;

/// Row-major pixels, y down, with the arrays of FILM_PARTS. Arrays other than rgba may be empty if they were not
/// requested. First hits are those of each pixel's centre ray.
struct Film {
    std::uint32_t width = 0, height = 0;
    FILM_PARTS(POINTRT_FILM_ARRAY)
};

#undef POINTRT_FILM_ARRAY

} // namespace pointrt
