// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud to splats: cleaning, normals, orientation, radii.
#pragma once

#include "preprocess/cloud/splats.h"
#include "preprocess/cloud/stage_progress.h"
#include "preprocess/surface/decisions.h"
#include "preprocess/surface/steps.h"
#include "preprocess/surface/surface_options.h"

namespace pointrt {

/// What the estimation did, for the report.
struct SurfaceReport {
    std::size_t duplicates_removed = 0; ///< points at exactly the position of an earlier one
    std::size_t outliers_removed = 0;
    std::size_t normals_estimated = 0;
    std::size_t normals_flipped = 0; ///< turned by orientation
    std::vector<float> noise; ///< [scans], standard deviation across the surface over the spacing; empty: not measured
    LevelReport steps;        ///< of depth cameras
    std::size_t clean_dropped = 0; ///< by cleaning: rims of range grids, points on no surface
    std::size_t clean_moved = 0;
    double seconds_neighbors = 0, seconds_normals = 0, seconds_orient = 0, seconds_clean = 0, seconds_radii = 0;
    std::size_t filled = 0;               ///< points put between scan lines
    surface::FillCounts filling{};        ///< what that was decided by
    std::size_t inner = 0, scattered = 0; ///< points that SurfaceDecisions::inner has, those of them on no surface
    std::size_t seen_through = 0;         ///< discs that ended where a sensor had looked through them
};

/// Turns the points of cloud (finite, fewer than 2^31) into splats.
/// The cloud is emptied while it is used, to keep the peak memory low; the result does not depend on the number of
/// threads. progress hears of the stages "neighbors", "normals", "orientation" and "radii".
/// Throws Error (kBadInput) when there are fewer than 3 points, when all are equal or lie on one line, and when
/// kKeep or kSensor lack a normal or a sensor; (kBadUsage) when an option is out of range. The message is the reason
/// alone: the caller puts the file's name and ": " before it.
Splats estimateSplats(Cloud&& cloud, const SurfaceOptions& options, SurfaceReport& report,
                      const StageProgress& progress = {}, const SurfaceDecisions& decided = {});

} // namespace pointrt
