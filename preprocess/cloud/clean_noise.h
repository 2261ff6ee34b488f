// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds for scans that count as clean.
#pragma once

#include <cstddef>

namespace pointrt {

/// A scan with less noise than this, relative to the point spacing, is clean, and its points do not move. Mesh samples
/// have 0.010 to 0.025, flat shapes 0, and the least noisy scans that look better after cleaning 0.09.
constexpr float kCleanNoise = 0.06f;

/// With fewer points, noise cannot be distinguished from shape.
constexpr std::size_t kFewForNoise = 1000;

} // namespace pointrt
