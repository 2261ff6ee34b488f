// SPDX-License-Identifier: GPL-3.0-or-later
// The splats of a tile's children in the frame of their parent.
#pragma once

#include <vector>

#include "preprocess/tiles/merge_disc.h"
#include "preprocess/tiles/merge_tile.h"
#include "preprocess/tiles/merge_values.h"

namespace pointrt {

struct MergeInput {
    std::vector<MergeSource> sources; ///< along a Morton curve
    MergeDiscs discs;                 ///< the same splats, in units of the parent's edge
};

/// @param edge of the parent's core, input units
MergeInput takeMergeInput(const TileKey& parent, const std::vector<MergeChild>& children, double edge);

/// Morton code of a place in the parent's core, [0, 1) on each axis.
std::uint64_t curveCode(const Vec3f& place);

/// The parent's position code of such a place.
PositionCode codeAt(const Vec3f& place);

} // namespace pointrt
