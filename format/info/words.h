// SPDX-License-Identifier: Apache-2.0
// Sizes, vectors and units as text.
#pragma once

#include <cstdint>
#include <string>

#include "pointrt/pro.h"

namespace pointrt {

/// "1.5 KiB (1536 bytes)".
std::string humanBytes(std::uint64_t bytes);

/// Three numbers with ten digits each, which resolve millimetres in a national grid.
std::string vectorText(const double v[3]);

/// "x", "-z", or the vector if it is not along an axis.
std::string upText(const pro_world& world);

std::string unitText(const pro_world& world);

} // namespace pointrt
