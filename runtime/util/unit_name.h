// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pointrt {

/// The abbreviation of the unit of this many metres: "m", "cm", "mm", "ft", "ftUS" (that of the US surveys before
/// 2023); "" if it is unknown (0) or another.
std::string unitName(double metres);

} // namespace pointrt
