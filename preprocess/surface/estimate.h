// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a cloud to splats: cleaning, normals, orientation, radii; or to balls, where points are on no surface.
#pragma once

#include "preprocess/cloud/splats.h"
#include "preprocess/cloud/stage_progress.h"
#include "preprocess/surface/decisions.h"
#include "preprocess/surface/dequantize.h"
#include "preprocess/surface/noise.h"
#include "preprocess/surface/surface_options.h"
#include "preprocess/surface/surround.h"

namespace pointrt {

/// Counts and times of the estimation, for the report.
struct SurfaceReport {
    std::size_t duplicates_removed = 0; ///< points at exactly the position of an earlier one
    std::size_t outliers_removed = 0;
    std::size_t normals_estimated = 0;
    std::size_t normals_flipped = 0; ///< by orientation
    std::vector<float> noise;      ///< [scans], standard deviation across the surface over the spacing; empty: unknown
    DequantizeReport dequantized;  ///< frames of depth cameras
    std::size_t clean_dropped = 0; ///< by cleaning: at silhouettes of range grids, or off the surface
    std::size_t clean_moved = 0;
    double seconds_neighbors = 0, seconds_normals = 0, seconds_orient = 0, seconds_clean = 0, seconds_radii = 0;
    std::size_t filled = 0;              ///< points inserted between scan lines
    surface::FillCounts filling{};       ///< for rowsToFill
    surface::SurroundCounts surround;    ///< for thinningOf; empty if that was decided
    surface::NoiseSamples noise_samples; ///< for noiseOf; empty without SurfaceDecisions::inner
    std::size_t inner = 0;               ///< points with SurfaceDecisions::inner set
    std::size_t scattered = 0;           ///< of those, points on no surface
    std::size_t seen_through = 0;        ///< discs shrunk because a sensor saw through them
    std::size_t balls = 0;               ///< splats that are balls
};

/// Whether the surface depends on the range grids of a cloud.
inline bool usesGrids(const SurfaceOptions& options) { return options.clean > 0 && options.splat != SplatShape::kBall; }

/// Converts the points of cloud (finite, fewer than 2^31) to splats.
/// Empties the cloud on the way, to limit peak memory. The result does not depend on the number of threads. Reports
/// progress of the stages "neighbors", "normals", "orientation", "cleaning" and "radii".
/// Throws Error: kBadInput if there are fewer than 3 points, if all are equal or on one line, or if normals or sensors
/// are missing for kKeep or kSensor; kBadUsage if an option is out of range. The message is the reason alone: the
/// caller prefixes the file's name and ": ".
Splats estimateSplats(Cloud&& cloud, const SurfaceOptions& options, SurfaceReport& report,
                      const StageProgress& progress = {}, const SurfaceDecisions& decided = {});

} // namespace pointrt
