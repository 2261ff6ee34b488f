// SPDX-License-Identifier: Apache-2.0
// What pointrt-info tells of a set, from set.json and the tiles' headers, for people and for programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/set/tile_set.h"

namespace pointrt {

struct SetLevelSummary {
    std::uint64_t tiles = 0, original_tiles = 0, splats = 0, stored = 0, bytes = 0;
    double error = 0;   ///< the largest, input units
    double spacing = 0; ///< median of its tiles', input units
};

struct SetSummary {
    std::vector<SetLevelSummary> levels; ///< the finest first
    SetLevelSummary all;                 ///< sums; no error or spacing
    std::vector<std::string> damaged;    ///< a line for each tile that is not there or not the one
};

/// Reads the tiles' headers.
SetSummary summarizeSet(const TileSet& set, const std::string& folder);

/// Several lines; free to change between versions.
std::string setSummaryText(const std::string& folder, const SetSummary& summary, const TileSet& set);

/// One JSON object; keys keep their meaning.
std::string setSummaryJson(const SetSummary& summary, const TileSet& set);

} // namespace pointrt
