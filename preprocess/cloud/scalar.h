// SPDX-License-Identifier: GPL-3.0-or-later
// Number types of scan attributes.
#pragma once

#include <cstddef>

namespace pointrt {

/// PRO_TYPE_* (pro_layout.h) minus one.
enum class Scalar { kI8, kU8, kI16, kU16, kI32, kU32, kI64, kU64, kF32, kF64 };

constexpr std::size_t scalarSize(Scalar type) {
    constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kSizes[static_cast<int>(type)];
}

constexpr bool isReal(Scalar type) { return type == Scalar::kF32 || type == Scalar::kF64; }

} // namespace pointrt
