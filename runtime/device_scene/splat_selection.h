// SPDX-License-Identifier: Apache-2.0
// Which splats filters show, and lists of near splats without the others, or of other sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/device_scene/splat_paint.h"

namespace pointrt {

/// Which of a scan's splats are in all selections, on all cores: bit i % 64 of word i / 64.
std::vector<std::uint64_t> shownSplats(const std::vector<SplatOverride::OfNumbers>& selections, std::size_t count);

/// Moves the splats that are not shown to a corner of the cube, where no ray is near: blended surfaces go without them.
/// @param words of the splats from number first on
void moveHiddenAway(const std::vector<std::uint64_t>& shown, std::size_t first, std::span<std::uint32_t> words);

/// Copies near splats (PRO_NEAR_WORDS each), on all cores. Those that are not shown become 0: nothing for programs
/// with balls, and for others discs without a normal, on whose planes no ray has a point.
/// @param listed the splat of each
void copyShownNear(const std::vector<std::uint64_t>& shown, std::span<const std::uint32_t> near,
                   std::span<const std::uint32_t> listed, std::span<std::uint32_t> copy);

/// Multiplies the radii of near splats by a factor, above 0 to 1, on all cores. Nothing stays nothing.
void resizeNear(float factor, std::span<std::uint32_t> near);

} // namespace pointrt
