// SPDX-License-Identifier: Apache-2.0
// Unit, resolution and coordinate system of a scene, for results.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

struct SceneUnits {
    std::string unit;           ///< "m", "ft", "ftUS", "mm", "cm", or "" if unknown or another
    double metres_per_unit = 0; ///< 0: unknown
    int decimals = 3;           ///< enough to resolve positions
    int epsg = 0;               ///< of the coordinate system, 0 if unknown
};

/// Throws Error kBadInput "FILE: reason" if a path is not a scene.
SceneUnits sceneUnits(const std::vector<std::string>& paths);

} // namespace pointrt
