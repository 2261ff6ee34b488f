// SPDX-License-Identifier: GPL-3.0-or-later
// Converts words to numbers of the type that a header declares.
#pragma once

#include <cmath>
#include <limits>

#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"

namespace pointrt {

enum class Stored {
    kExactly, ///< stored exactly, or rounded to the precision of a real
    kNearest, ///< the number is out of range or, for an integer type, not an integer
    kNothing  ///< the word is not a number
};

/// The number of an integer type that is nearest to value; 0 for NaN.
template <typename Integer>
Integer nearestInteger(double value) {
    if (!(value > static_cast<double>(std::numeric_limits<Integer>::lowest())))
        return std::isnan(value) ? Integer{0} : std::numeric_limits<Integer>::lowest();
    if (value >= static_cast<double>(std::numeric_limits<Integer>::max())) return std::numeric_limits<Integer>::max();
    return static_cast<Integer>(std::llround(value));
}

template <typename Integer>
Stored storeIntegerWord(std::string_view word, char* into) {
    Integer number = 0;
    Stored stored = Stored::kExactly;
    if (!wholeInteger(word, number)) {
        double value = 0;
        if (!wholeNumber(word, value)) return Stored::kNothing;
        number = nearestInteger<Integer>(value);
        if (static_cast<double>(number) != value) stored = Stored::kNearest;
    }
    std::memcpy(into, &number, sizeof number);
    return stored;
}

/// Stores the number in word to `into`: scalarSize(type) bytes in the machine's order.
inline Stored storeWord(std::string_view word, Scalar type, char* into) {
    switch (type) {
    case Scalar::kI8:
        return storeIntegerWord<std::int8_t>(word, into);
    case Scalar::kU8:
        return storeIntegerWord<std::uint8_t>(word, into);
    case Scalar::kI16:
        return storeIntegerWord<std::int16_t>(word, into);
    case Scalar::kU16:
        return storeIntegerWord<std::uint16_t>(word, into);
    case Scalar::kI32:
        return storeIntegerWord<std::int32_t>(word, into);
    case Scalar::kU32:
        return storeIntegerWord<std::uint32_t>(word, into);
    case Scalar::kI64:
        return storeIntegerWord<std::int64_t>(word, into);
    case Scalar::kU64:
        return storeIntegerWord<std::uint64_t>(word, into);
    default:
        break;
    }
    double value = 0;
    if (!wholeNumber(word, value)) return Stored::kNothing;
    storeScalar(into, type, value);
    return Stored::kExactly;
}

/// Copies a number of a binary file. swap_bytes: it is big-endian
inline void storeBytes(const char* from, Scalar type, bool swap_bytes, char* into) {
    const std::size_t size = scalarSize(type);
    std::memcpy(into, from, size);
    if (swap_bytes) std::reverse(into, into + size);
}

} // namespace pointrt
