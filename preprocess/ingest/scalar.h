// SPDX-License-Identifier: GPL-3.0-or-later
// Scalars of binary scan files.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "preprocess/cloud/scalar.h"

namespace pointrt {

static_assert(std::endian::native == std::endian::little, "binary scans are read on little-endian machines");

template <typename Value>
double loadAs(const char* at, bool swap_bytes) {
    char bytes[sizeof(Value)];
    std::memcpy(bytes, at, sizeof(Value));
    if (swap_bytes) std::reverse(bytes, bytes + sizeof(Value));
    return static_cast<double>(std::bit_cast<Value>(bytes));
}

/// Reads scalarSize(type) bytes at `at`. swap_bytes: they are big-endian
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

/// Loads an integer of any type as 64 bits of two's complement.
inline std::uint64_t loadWhole(const char* at, Scalar type) {
    const std::size_t size = scalarSize(type);
    std::uint64_t bits = 0;
    std::memcpy(&bits, at, size);
    const bool has_sign = type == Scalar::kI8 || type == Scalar::kI16 || type == Scalar::kI32;
    const bool negative = has_sign && bits >> (8 * size - 1) != 0;
    return negative ? bits | ~std::uint64_t{0} << (8 * size) : bits;
}

/// Stores the low bytes of an integer.
inline void storeWhole(char* at, Scalar type, std::uint64_t bits) { std::memcpy(at, &bits, scalarSize(type)); }

/// Stores a number in a type that can hold it.
inline void storeScalar(char* at, Scalar type, double value) {
    const auto put = [at](const auto& number) { std::memcpy(at, &number, sizeof number); };
    if (type == Scalar::kF64) return put(value);
    if (type == Scalar::kF32) return put(static_cast<float>(value));
    if (type == Scalar::kU64) return put(static_cast<std::uint64_t>(value));
    storeWhole(at, type, static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
}

} // namespace pointrt
