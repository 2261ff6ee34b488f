// SPDX-License-Identifier: GPL-3.0-or-later
// How wide the discs of a set may be, by all of its original splats, as one file has it by all of its own.
#pragma once

#include "preprocess/tiles/plan.h"
#include "preprocess/tiles/tile_tree.h"

namespace pointrt {

/// Input units; infinity where nothing limits them, or the blocks have done so. Found when it is first asked for, for
/// which all blocks must have been baked, and kept beside the plan. The same for whichever process asks. Throws Error.
float widestRadius(const SetPlan& plan, const TileTree& tree);

/// Of the original tiles' splats by radiusLimitRule, to the bit. Two readings of their radii, and no more of them in
/// memory than one tile's. Throws Error (kBadInput).
float findWidestRadius(const TileTree& tree, const std::string& splats_folder);

} // namespace pointrt
