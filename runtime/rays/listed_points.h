// SPDX-License-Identifier: Apache-2.0
// Points as text or as a NumPy array.
#pragma once

#include <memory>
#include <string>

#include "runtime/rays/point_source.h"

namespace pointrt {

/// Rows of x, y, z, optionally with a normal, in the scan's coordinates. All points are held in memory.
/// @param scene supplies the coordinate system, unit and position step
/// Throws Error kBadInput "FILE[:LINE]: reason".
std::unique_ptr<PointSource> listedPoints(const std::string& file, const PointOutline& scene);

} // namespace pointrt
