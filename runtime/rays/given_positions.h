// SPDX-License-Identifier: Apache-2.0
// Positions on the command line or in a file.
#pragma once

#include <string>
#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

/// Positions with as many coordinates as were given.
struct GivenPositions {
    std::vector<Position> positions; ///< z is 0 if only two coordinates were given
    bool has_z = true;
};

/// "x,y,z x,y,z ...", or a file, or - for standard input: text with three numbers a line, or a NumPy array (N, 3).
/// @param plane also accept positions of two coordinates
/// Throws Error kBadUsage "OPTION: reason" for the list, kBadInput "FILE[:LINE]: reason" for files.
GivenPositions givenPositions(const std::string& text, const std::string& option, bool plane);

} // namespace pointrt
