// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pointrt {

/// The abbreviation of the unit with a length of this many metres: "m", "cm", "mm", "ft", "ftUS" (the US survey foot,
/// used until 2022); "" if it is unknown (0) or another.
std::string unitName(double metres);

} // namespace pointrt
