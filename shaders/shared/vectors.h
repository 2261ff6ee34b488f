// SPDX-License-Identifier: Apache-2.0
// GLSL's vectors for C++, so that a struct is written once. Structs are rows of 16 bytes: a vector of four, one of
// three with a number behind it, or four numbers. Both languages then agree on every offset without padding, which
// POINTRT_ROWS and POINTRT_ROW assert as far as C++ can see it.
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

/// type has so many rows of 16 bytes, and member starts one.
#define POINTRT_ROWS(type, rows) static_assert(sizeof(type) == 16 * (rows) && alignof(type) == 4)
#define POINTRT_ROW(type, member) static_assert(offsetof(type, member) % 16 == 0)

#endif
