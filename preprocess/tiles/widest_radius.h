// SPDX-License-Identifier: GPL-3.0-or-later
// The radius limit of a set's discs, found from all of its original splats as single files find theirs.
#pragma once

#include "preprocess/tiles/plan.h"
#include "preprocess/tiles/tile_tree.h"

namespace pointrt {

/// Input units; infinity if there is no limit, or if the blocks have applied it already. Computed on first use, when
/// all blocks must have been baked, and stored beside the plan; every process gets the same value. Throws Error.
float widestRadius(const SetPlan& plan, const TileTree& tree);

/// radiusLimitRule applied to the original tiles' splats, exactly. Reads their radii twice, with one tile's in memory
/// at a time. Throws Error (kBadInput).
float findWidestRadius(const TileTree& tree, const std::string& splats_folder);

} // namespace pointrt
