// SPDX-License-Identifier: GPL-3.0-or-later
// What counts as clean, wherever noise is measured.
#pragma once

#include <cstddef>

namespace pointrt {

/// Below this noise, over the spacing, a scan is clean, and nothing of it moves. Samples of meshes have 0.010 to 0.025,
/// shapes without curvature 0, the quietest scans that look better for cleaning 0.09.
constexpr float kCleanNoise = 0.06f;

/// Fewer points are too few to tell noise from shape.
constexpr std::size_t kFewForNoise = 1000;

} // namespace pointrt
