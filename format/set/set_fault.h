// SPDX-License-Identifier: Apache-2.0
// Internal to format/set: the reason why a set is invalid.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace pointrt {

/// what() is place and reason, without the file's name.
struct SetFault : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// @param place such as "tiles[3]: "
inline void requireOf(bool holds, const char* place, const char* reason) {
    if (!holds) throw SetFault(std::string(place) + reason);
}

inline std::string placeIn(const char* list, std::size_t number) {
    return std::string(list) + "[" + std::to_string(number) + "]: ";
}

} // namespace pointrt
