// SPDX-License-Identifier: GPL-3.0-or-later
// The storage order of splats in files and tiles.
#pragma once

#include <cstdint>

#include "preprocess/cloud/splats.h"

namespace pointrt {

/// A splat on the Morton curve. At equal codes splats that fill gaps come last.
struct CurveKey {
    std::uint64_t code = 0;
    std::uint32_t index = 0; ///< of the splat
    bool fills = false;
    bool operator<(const CurveKey& other) const {
        if (code != other.code) return code < other.code;
        return fills != other.fills ? other.fills : index < other.index;
    }
};

/// Whether splat i fills a gap between points.
inline bool fillsGap(const Splats& splats, std::size_t i) {
    return !splats.filled_from.empty() && splats.input_index[i] >= splats.input_count;
}

} // namespace pointrt
