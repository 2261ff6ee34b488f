// SPDX-License-Identifier: Apache-2.0
// Vectors and words of the tracing index.
#pragma once

#include <cstdint>

#include "format/index/cell_codec.h"
#include "pointrt/pro_index_layout.h"
#include "runtime/util/vec.h"

namespace pointrt::test {

inline Vec3 toVec3(const Vector& v) { return {v[0], v[1], v[2]}; }
inline Vector toVector(Vec3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// A signed field of a word: count bits from bit first on.
inline int signedField(std::uint32_t word, int first, int count) {
    return static_cast<int>(word << (32 - first - count)) >> (32 - count);
}

/// Whether a word of the entry grid or of a brick names something, instead of cells to skip.
inline bool isFilled(std::uint32_t word) { return (word & PRO_SKIP_MASK) == 0; }

} // namespace pointrt::test
