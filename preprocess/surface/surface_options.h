// SPDX-License-Identifier: GPL-3.0-or-later
// What the user may choose of the way from a cloud to splats.
#pragma once

namespace pointrt {

enum class NormalSource {
    kAuto,    ///< keeps the normals that are given (finite and not zero), estimates the others
    kKeep,    ///< every point must have one
    kEstimate ///< estimates all, whatever is given
};

enum class OrientMode {
    kAuto,   ///< given normals keep their side, then towards the sensor where it is known, then by spanning tree
    kSensor, ///< towards the sensor, which every point must have
    kUp,     ///< upwards; what is too steep to tell follows its neighbours
    kMst,    ///< by minimum spanning tree, whatever is known
    kNone    ///< normals stay as they are given or fitted, on any side
};

struct SurfaceOptions {
    NormalSource normals = NormalSource::kAuto;
    OrientMode orient = OrientMode::kAuto;
    int neighbors = 16;        ///< K of the normal estimation, 3 to 255; all but the point itself in smaller clouds
    double radius_scale = 1.0; ///< multiplies every radius, above 0
    bool remove_outliers = true;
    double clean = 1.0; ///< strength of cleaning, 0: none
};

} // namespace pointrt
