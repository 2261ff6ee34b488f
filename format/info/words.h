// SPDX-License-Identifier: Apache-2.0
// How lengths, sizes and directions read, of files and of sets.
#pragma once

#include <cstdint>
#include <string>

#include "pointrt/pro.h"

namespace pointrt {

/// "1.5 KiB (1536 bytes)".
std::string humanBytes(std::uint64_t bytes);

/// Ten digits: millimetres in a national grid of metres.
std::string vectorText(const double v[3]);

/// "x", "-z", or the vector where it is along none of the axes.
std::string upText(const pro_world& world);

std::string unitText(const pro_world& world);

} // namespace pointrt
