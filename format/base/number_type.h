// SPDX-License-Identifier: Apache-2.0
// PRO_TYPE_* as C++ types and as names.
#pragma once

#include <cstdint>

#include "pointrt/pro_layout.h"

namespace pointrt {

/// Calls use(a value of the C++ type). @param type a valid PRO_TYPE_*
template <typename Use>
auto withType(std::uint32_t type, const Use& use) {
    switch (type) {
    case PRO_TYPE_I8:
        return use(std::int8_t{});
    case PRO_TYPE_U8:
        return use(std::uint8_t{});
    case PRO_TYPE_I16:
        return use(std::int16_t{});
    case PRO_TYPE_U16:
        return use(std::uint16_t{});
    case PRO_TYPE_I32:
        return use(std::int32_t{});
    case PRO_TYPE_U32:
        return use(std::uint32_t{});
    case PRO_TYPE_I64:
        return use(std::int64_t{});
    case PRO_TYPE_U64:
        return use(std::uint64_t{});
    case PRO_TYPE_F32:
        return use(float{});
    default:
        return use(double{});
    }
}

/// Whether a type has integers of 64 bits, which many formats lack.
inline bool isWideInteger(std::uint32_t type) { return type == PRO_TYPE_I64 || type == PRO_TYPE_U64; }

/// The name of a PRO_TYPE_*, such as "uint16"; "unknown" for other numbers.
inline const char* typeName(std::uint32_t type) {
    constexpr const char* kNames[] = {"int8",   "uint8", "int16",  "uint16", "int32",
                                      "uint32", "int64", "uint64", "float",  "double"};
    return type >= PRO_TYPE_I8 && type <= PRO_TYPE_F64 ? kNames[type - PRO_TYPE_I8] : "unknown";
}

} // namespace pointrt
