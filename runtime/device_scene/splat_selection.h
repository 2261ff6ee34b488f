// SPDX-License-Identifier: Apache-2.0
// Which splats filters show, and copies of near splats without the hidden ones or with other radii.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/device_scene/splat_paint.h"

namespace pointrt {

/// Which of a scan's splats are in all selections, on all cores: bit i % 64 of word i / 64.
std::vector<std::uint64_t> shownSplats(const std::vector<SplatOverride::OfNumbers>& selections, std::size_t count);

/// Moves the hidden splats to a corner of the cube that no ray comes near, so that blended surfaces leave them out.
/// @param words of the splats from number first on
void moveHiddenAway(const std::vector<std::uint64_t>& shown, std::size_t first, std::span<std::uint32_t> words);

/// Copies near splats (PRO_NEAR_WORDS each), on all cores. Hidden ones become 0: programs with balls read that as no
/// splat, others as a disc without a normal, whose plane no ray hits.
/// @param listed the splat of each
void copyShownNear(const std::vector<std::uint64_t>& shown, std::span<const std::uint32_t> near,
                   std::span<const std::uint32_t> listed, std::span<std::uint32_t> copy);

/// Multiplies the radii of near splats by a factor above 0 and up to 1, on all cores. Entries without a splat stay
/// empty.
void resizeNear(float factor, std::span<std::uint32_t> near);

} // namespace pointrt
