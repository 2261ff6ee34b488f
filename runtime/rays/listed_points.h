// SPDX-License-Identifier: Apache-2.0
// Points of a list: text, or a NumPy array.
#pragma once

#include <memory>
#include <string>

#include "runtime/rays/point_source.h"

namespace pointrt {

/// x, y, z, or these and a normal, in the scan's coordinates; all of them are held in memory.
/// @param scene what is said of the scene's points: coordinate system and the steps of coordinates are theirs
/// Throws Error kBadInput "FILE[:LINE]: reason".
std::unique_ptr<PointSource> listedPoints(const std::string& file, const PointOutline& scene);

} // namespace pointrt
