// SPDX-License-Identifier: Apache-2.0
// GLSL's vectors for C++, so that a struct is written once. Structs hold 16-byte vectors only: both languages then
// agree on every offset without padding.
#ifndef POINTRT_SHADERS_VECTORS_H
#define POINTRT_SHADERS_VECTORS_H

#include <cstdint>

namespace pointrt::gpu {
using uint = std::uint32_t;
struct vec4 {
    float x, y, z, w;
};
struct uvec4 {
    uint x, y, z, w;
};
} // namespace pointrt::gpu

#endif
