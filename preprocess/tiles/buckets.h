// SPDX-License-Identifier: GPL-3.0-or-later
// Points of tiles as the split has left them on disk: a bucket a tile.
#pragma once

#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Points of a box, out of the buckets of all tiles that it reaches into.
struct BoxPoints {
    /// In the order of scans, in each of them of tiles, in each of these of the input. Origin is the corner of the core
    /// asked for, or of the box; all scans of the plan are there, with those of no point among them; sensors, frame and
    /// attributes are as a bake of all files in one would have them.
    Cloud cloud;
    std::vector<std::uint8_t> core; ///< [points], 1: in the core of the tile that was asked for
    /// Of the plan's sides those in the box, relative to cloud.origin.
    std::vector<Vec3f> side_positions, side_normals;
};

/// The points of a tile's core alone. Throws Error (kBadInput) naming a bucket that is missing, cut short or damaged.
Cloud readBucket(const SetPlan& plan, std::uint32_t tile);

/// A tile's core and what lies up to halo away from it, on each axis.
PlanBox boxAround(const SetPlan& plan, const PlanTile& tile, double halo);

/// How many points readPoints would return, or some number above most where they are more. Throws as readBucket.
std::uint64_t countPoints(const SetPlan& plan, std::uint32_t tile, double halo, std::uint64_t most);

/// The points of a tile's core and those up to halo away from it, on each axis; same for any order of jobs.
/// Throws as readBucket.
BoxPoints readPoints(const SetPlan& plan, std::uint32_t tile, double halo);

/// The points of any box, none of them core.
BoxPoints readPoints(const SetPlan& plan, const PlanBox& box);

} // namespace pointrt
