// SPDX-License-Identifier: GPL-3.0-or-later
// Colours, noise and attributes of merged splats: area-weighted from their members.
#pragma once

#include <span>

#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// A splat of one of several tiles.
struct MergeSource {
    std::uint32_t tile = 0, splat = 0;
};

/// Members of one merged splat, with their areas in any unit.
struct MergeGroup {
    std::span<const MergeSource> members;
    std::span<const float> areas;
};

/// The mean in linear light, as sRGB.
Rgb8 meanColor(const std::vector<SplatsView>& tiles, const MergeGroup& group);

/// The root mean square.
float meanNoise(const std::vector<SplatsView>& tiles, const MergeGroup& group);

/// Whether an attribute is categorical, so that the value with the largest area is kept: classes, flags, numbers of
/// scans, returns, lines and grid cells, and 64-bit integers. Others become the mean, rounded for integers, in linear
/// light for 16-bit colours; NaN is ignored.
bool isCategorical(const Attribute& attribute);

/// Writes the group's value of an attribute to `to`.
void mergeValue(const std::vector<SplatsView>& tiles, std::size_t attribute, const Attribute& schema,
                const MergeGroup& group, char* to);

} // namespace pointrt
