// SPDX-License-Identifier: GPL-3.0-or-later
// What merged splats carry: colours, noise and attributes of their members, by area.
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

/// The mean in linear light, sRGB.
Rgb8 meanColor(const std::vector<SplatsView>& tiles, const MergeGroup& group);

/// The root of the mean square.
float meanNoise(const std::vector<SplatsView>& tiles, const MergeGroup& group);

/// Whether an attribute's values name something, so that the one with the largest area stays: classes, flags, numbers
/// of scans, returns, lines and places of the scanner's grid, and whole numbers of 64 bits. Of others the mean stays,
/// rounded where they are whole, of 16-bit colours the one in linear light; what is not a number does not count.
bool isName(const Attribute& attribute);

/// Writes the group's value of an attribute to `to`.
void mergeValue(const std::vector<SplatsView>& tiles, std::size_t attribute, const Attribute& schema,
                const MergeGroup& group, char* to);

} // namespace pointrt
