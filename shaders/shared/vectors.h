// SPDX-License-Identifier: Apache-2.0
// GLSL vector types for C++, so that shared structs are written once. Structs consist of rows of 16 bytes: a vec4, a
// vec3 followed by a scalar, or four scalars. Both languages then agree on every offset without padding; POINTRT_ROWS
// and POINTRT_ROW assert it on the C++ side.
#ifndef POINTRT_SHADERS_VECTORS_H
#define POINTRT_SHADERS_VECTORS_H

#include <cstddef>
#include <cstdint>

namespace pointrt::gpu {
using uint = std::uint32_t;
struct vec3 {
    float x, y, z;
};
struct uvec3 {
    uint x, y, z;
};
struct vec4 {
    float x, y, z, w;
};
struct uvec4 {
    uint x, y, z, w;
};
} // namespace pointrt::gpu

/// Assert that type has this many rows of 16 bytes, and that member starts a row.
#define POINTRT_ROWS(type, rows) static_assert(sizeof(type) == 16 * (rows) && alignof(type) == 4)
#define POINTRT_ROW(type, member) static_assert(offsetof(type, member) % 16 == 0)

#endif
