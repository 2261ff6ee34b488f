// SPDX-License-Identifier: Apache-2.0
// The summary of a tile set that pointrt-info prints as text or JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/set/tile_set.h"

namespace pointrt {

struct SetLevelSummary {
    std::uint64_t tiles = 0, original_tiles = 0, splats = 0, stored = 0, bytes = 0;
    double error = 0;   ///< largest of its tiles, input units
    double spacing = 0; ///< median of its tiles, input units
};

struct SetSummary {
    std::vector<SetLevelSummary> levels; ///< finest first
    SetLevelSummary all;                 ///< sums; without error and spacing
    std::vector<std::string> damaged;    ///< a line for each missing or mismatching tile
};

/// Reads set.json and the headers of all tiles.
SetSummary summarizeSet(const TileSet& set, const std::string& folder);

/// Several lines, which may change between versions.
std::string setSummaryText(const std::string& folder, const SetSummary& summary, const TileSet& set);

/// One JSON object; its keys are stable.
std::string setSummaryJson(const SetSummary& summary, const TileSet& set);

} // namespace pointrt
