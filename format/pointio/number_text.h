// SPDX-License-Identifier: Apache-2.0
// Numbers as text.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstring>
#include <string>

#include "format/base/number_type.h"

namespace pointrt {

/// Appends the number at from in its shortest form that reads back exactly.
/// @param type PRO_TYPE_*
inline void appendNumber(std::uint32_t type, const std::byte* from, std::string& text) {
    withType(type, [&](auto number) {
        std::memcpy(&number, from, sizeof number);
        char room[32]; // room for the longest double, which has 24 characters
        text.append(room, std::to_chars(room, room + sizeof room, number).ptr);
    });
}

} // namespace pointrt
