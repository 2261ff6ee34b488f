// SPDX-License-Identifier: Apache-2.0
// Converts vectors between host and device.
#pragma once

#include "runtime/util/color.h"
#include "runtime/util/vec.h"
#include "shaders/shared/vectors.h"

namespace pointrt {

/// Rounds to float.
inline gpu::vec4 pack(Vec3 v, double w = 0) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}
inline gpu::vec4 packColor(const Color& color, float w = 0) { return {color[0], color[1], color[2], w}; }
inline Color scaled(const Color& color, double factor) {
    return {static_cast<float>(factor * color[0]), static_cast<float>(factor * color[1]),
            static_cast<float>(factor * color[2])};
}

inline Vec3 unpack(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

} // namespace pointrt
