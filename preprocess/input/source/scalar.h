// SPDX-License-Identifier: GPL-3.0-or-later
// Scalars of binary scan files.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pointrt {

static_assert(std::endian::native == std::endian::little, "binary scans are read on little-endian machines");

enum class Scalar { kI8, kU8, kI16, kU16, kI32, kU32, kI64, kU64, kF32, kF64 };

constexpr std::size_t scalarSize(Scalar type) {
    constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kSizes[static_cast<int>(type)];
}

constexpr bool isReal(Scalar type) { return type == Scalar::kF32 || type == Scalar::kF64; }

template <typename Value>
double loadAs(const char* at, bool swap_bytes) {
    char bytes[sizeof(Value)];
    std::memcpy(bytes, at, sizeof(Value));
    if (swap_bytes) std::reverse(bytes, bytes + sizeof(Value));
    return static_cast<double>(std::bit_cast<Value>(bytes));
}

/// Reads scalarSize(type) bytes at `at`, big-endian ones when swap_bytes.
inline double loadScalar(const char* at, Scalar type, bool swap_bytes) {
    switch (type) {
    case Scalar::kI8:
        return loadAs<std::int8_t>(at, false);
    case Scalar::kU8:
        return loadAs<std::uint8_t>(at, false);
    case Scalar::kI16:
        return loadAs<std::int16_t>(at, swap_bytes);
    case Scalar::kU16:
        return loadAs<std::uint16_t>(at, swap_bytes);
    case Scalar::kI32:
        return loadAs<std::int32_t>(at, swap_bytes);
    case Scalar::kU32:
        return loadAs<std::uint32_t>(at, swap_bytes);
    case Scalar::kI64:
        return loadAs<std::int64_t>(at, swap_bytes);
    case Scalar::kU64:
        return loadAs<std::uint64_t>(at, swap_bytes);
    case Scalar::kF32:
        return loadAs<float>(at, swap_bytes);
    case Scalar::kF64:
        return loadAs<double>(at, swap_bytes);
    }
    return 0;
}

} // namespace pointrt
