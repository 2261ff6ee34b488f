// SPDX-License-Identifier: Apache-2.0
// Where scans lie in the world, according to their files.
#pragma once

#include <optional>
#include <string>

#include "runtime/device_scene/render_space.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The frame of a .pro or tile set, in its own coordinates.
struct ScanFrame {
    Bounds bounds; ///< of its splats
    Vec3 up;       ///< 0 if unknown
    std::string crs;
    double metres_per_unit = 0; ///< 0: unknown, or degrees
};

/// Throws Error kBadInput "FILE: reason".
ScanFrame frameOfScan(const std::string& path);

/// A place on the Earth, and the rotation of the map there.
struct EarthPlace {
    double latitude_deg = 0, longitude_deg = 0; ///< north and east positive
    double convergence_deg = 0;                 ///< from true north to the grid's north, clockwise
};

/// The middle of the first scan that is not moved and whose file states a projected coordinate system. None if there is
/// no such scan, or no PROJ. Throws as frameOfScan does.
std::optional<EarthPlace> earthPlaceOf(const SceneDescription& scene);

} // namespace pointrt
