// SPDX-License-Identifier: Apache-2.0
// What comes out of rendering: the plain structs between the tracer and the image files.
#pragma once

#include <cstdint>
#include <vector>

#include "shaders/shared/film_parts.h"

namespace pointrt {

/// Rays counted on the device while tracing.
struct RayCounts {
    std::uint64_t primary = 0, shadow = 0, secondary = 0;
};

#define POINTRT_FILM_ARRAY(array, Value, channels, group, nothing, source, view) std::vector<Value> array;

/// Row-major pixels, y down. Its arrays are those of FILM_PARTS; but for rgba each may be empty: not asked for. Those
/// of first hits belong to the pixel's centre ray.
struct Film {
    std::uint32_t width = 0, height = 0;
    FILM_PARTS(POINTRT_FILM_ARRAY)
};

#undef POINTRT_FILM_ARRAY

} // namespace pointrt
