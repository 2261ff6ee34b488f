// SPDX-License-Identifier: Apache-2.0
// The point classes of LAS files.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/scene/color_map.h"

namespace pointrt {

/// The name of a class in ASPRS, LAS Specification 1.4 R15, table 17; "class N" if it has none.
std::string className(std::uint8_t number);

/// The specification defines no colours. LAS viewers commonly show ground brown, vegetation green, buildings orange,
/// noise magenta and water blue; the other colours are chosen to be distinct.
Srgb8 classColor(std::uint8_t number);

} // namespace pointrt
