// SPDX-License-Identifier: Apache-2.0
// Beams of a tile of pixels through the tiles in a block: for each tile of the block, the distance that the rays can
// skip, and a mask of the tiles that their beam does not miss.
#ifndef POINTRT_SHADERS_POOL_BEAM_GLSL
#define POINTRT_SHADERS_POOL_BEAM_GLSL
#include "shaders/shared/spec_constants.h"

// Places in the masks: at least the number of tiles in the block.
layout(constant_id = SPEC_CULL_BOXES) const uint kCullBoxes = CULL_INSTANCES;

uint beamPlace(uint tile, uint place) { return tile * kCullBoxes + place; }

// The masks are stored in place of the cull masks, which pooled tiles do not need.
uint beamMaskPlace(uint tile) { return cullMaskStart() + tile; }
uint beamMask(uint tile) { return loadQueue(beamMaskPlace(tile)); }

#endif
