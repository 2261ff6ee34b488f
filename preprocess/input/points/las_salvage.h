// SPDX-License-Identifier: GPL-3.0-or-later
// Recovers the complete points of LAZ files that are damaged or truncated.
#pragma once

#include <functional>
#include <string>

#include "preprocess/input/points/las_blocks.h"

namespace pointrt {

struct SalvagedLas {
    std::uint64_t points = 0;
    std::string fault; ///< of the first chunk that is not whole; "" if all are
};

/// Decompresses point by point and calls use with blocks of the points before the first malformed one of each chunk.
/// Leaves out points just before it that are outside the header's bounds, as bytes beyond the last point decode to
/// arbitrary values.
SalvagedLas salvageLas(const LasPlan& plan, const std::function<void(const LasBlock&)>& use);

} // namespace pointrt
