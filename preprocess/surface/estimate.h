// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud to splats: cleaning, normals, orientation, radii.
#pragma once

#include <functional>

#include "preprocess/surface/splats.h"

namespace pointrt {

enum class NormalSource {
    kAuto,    ///< keeps the normals that are given (finite and not zero), estimates the others
    kKeep,    ///< every point must have one
    kEstimate ///< estimates all, whatever is given
};

enum class OrientMode {
    kAuto,   ///< given normals keep their side, then towards the sensor where it is known, then by spanning tree
    kSensor, ///< towards the sensor, which every point must have
    kMst,    ///< by minimum spanning tree, whatever is known
    kNone    ///< normals stay as they are given or fitted, on any side
};

struct SurfaceOptions {
    NormalSource normals = NormalSource::kAuto;
    OrientMode orient = OrientMode::kAuto;
    int neighbors = 16;        ///< K of the normal estimation, 3 to 255; all but the point itself in smaller clouds
    double radius_scale = 1.0; ///< multiplies every radius, above 0
    bool remove_outliers = true;
};

/// What the estimation did, for the report.
struct SurfaceReport {
    std::size_t duplicates_removed = 0; ///< points at exactly the position of an earlier one
    std::size_t outliers_removed = 0;
    std::size_t normals_estimated = 0;
    std::size_t normals_flipped = 0; ///< turned by orientation
    double seconds_neighbors = 0, seconds_normals = 0, seconds_orient = 0, seconds_radii = 0;
};

/// Called with a stage name ("neighbors", "normals", "orientation", "radii") and the share of it done in [0, 1],
/// from the calling thread only.
using StageProgress = std::function<void(const char* stage, double share)>;

/// Turns the points of cloud (finite, fewer than 2^31) into splats.
/// The cloud is emptied while it is used, to keep the peak memory low; the result does not depend on the number of
/// threads.
/// Throws Error (kBadInput) when there are fewer than 3 points, when all are equal or lie on one line, and when
/// kKeep or kSensor lack a normal or a sensor; (kBadUsage) when an option is out of range. The message is the reason
/// alone: the caller puts the file's name and ": " before it.
Splats estimateSplats(Cloud&& cloud, const SurfaceOptions& options, SurfaceReport& report,
                      const StageProgress& progress = {});

} // namespace pointrt
