// SPDX-License-Identifier: GPL-3.0-or-later
// Reads points of tiles from the buckets on disk that the split wrote, one per tile.
#pragma once

#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Points of a box, from the buckets of all tiles that it overlaps.
struct BoxPoints {
    /// Points sorted by scan, then by tile, then in the order of the input. The origin is the corner of the tile's core
    /// or of the box. Has all scans of the plan, including those without a point; sensors, frame and attributes are as
    /// in a bake of all files at once.
    Cloud cloud;
    std::vector<std::uint8_t> core; ///< [points], 1: in the core of the given tile
    /// For SurfaceDecisions::silhouettes.
    std::vector<std::uint8_t> silhouettes;
    /// The plan's sides within the box, relative to cloud.origin.
    std::vector<Vec3f> side_positions, side_normals;
};

/// The points of a tile's core only. Throws Error (kBadInput) if a bucket is missing, truncated or damaged.
Cloud readBucket(const SetPlan& plan, std::uint32_t tile);

/// A tile's core, extended by halo on each side.
PlanBox boxAround(const SetPlan& plan, const PlanTile& tile, double halo);

/// Number of points that readPoints would return; stops counting above `most`. Throws as readBucket.
std::uint64_t countPoints(const SetPlan& plan, std::uint32_t tile, double halo, std::uint64_t most);

/// The points of a tile's core and its halo; the same for any order of jobs.
/// Throws as readBucket.
BoxPoints readPoints(const SetPlan& plan, std::uint32_t tile, double halo);

/// The points of any box, none of them flagged as core.
BoxPoints readPoints(const SetPlan& plan, const PlanBox& box);

} // namespace pointrt
