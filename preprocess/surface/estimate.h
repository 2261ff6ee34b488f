// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud to splats: cleaning, normals, orientation, radii.
#pragma once

#include <functional>

#include "preprocess/surface/splats.h"

namespace pointrt {

enum class NormalSource { kAuto, kKeep, kEstimate };
enum class OrientMode { kAuto, kSensor, kMst, kNone };

struct SurfaceOptions {
    NormalSource normals = NormalSource::kAuto;
    OrientMode orient = OrientMode::kAuto;
    int neighbors = 16;        ///< K of the normal estimation, 3 to 255
    double radius_scale = 1.0; ///< multiplies every radius, above 0
    bool remove_outliers = true;
};

/// What the estimation did, for the report.
struct SurfaceReport {
    std::size_t duplicates_removed = 0;
    std::size_t outliers_removed = 0;
    std::size_t normals_estimated = 0;
    std::size_t normals_flipped = 0; ///< turned by orientation
    double seconds_neighbors = 0, seconds_normals = 0, seconds_orient = 0, seconds_radii = 0;
};

/// Called with a stage name and the share done in [0, 1].
using StageProgress = std::function<void(const char* stage, double share)>;

/// Throws Error (kBadInput) when the points span no surface: fewer than 3 distinct points, all equal or collinear.
/// cloud is emptied while it is used, to keep the peak memory low. The result does not depend on threads.
Splats estimateSplats(Cloud&& cloud, const SurfaceOptions& options, SurfaceReport& report, const StageProgress& progress = {});

} // namespace pointrt
