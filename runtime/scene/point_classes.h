// SPDX-License-Identifier: Apache-2.0
// The classes of points in LAS files.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/scene/color_map.h"

namespace pointrt {

/// Its name by ASPRS, LAS Specification 1.4 R15, table 17; "class N" where that has none.
std::string className(std::uint8_t number);

/// The specification names no colours. Ground brown, vegetation green, buildings orange, noise magenta and water blue
/// are what viewers of LAS files agree on; the others are chosen here to be told apart.
Srgb8 classColor(std::uint8_t number);

} // namespace pointrt
