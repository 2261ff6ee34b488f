// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussians in tile sets: each belongs to the tile whose core holds its mean, and to no other. Rays composite the
// Gaussians of all tiles in one order, so tiles need no copies of their neighbours' Gaussians.
#pragma once

#include <string>
#include <vector>

#include "preprocess/octree/gaussians.h"
#include "preprocess/tiles/plan.h"
#include "preprocess/tiles/tile_splats.h"

namespace pointrt {

/// Where a mean lies within its position step, 0 to 1 on each axis: an attribute of splat files. Three 32-bit floats.
inline constexpr const char* kGaussianFraction = "gaussian_fraction";

/// Whether points with these attributes are Gaussians.
bool holdsGaussians(const std::vector<Attribute>& attributes);
bool holdsGaussians(const SetPlan& plan);

/// The Gaussians of a tile's core, from its bucket. Throws Error as readBucket.
TileSplats gaussiansOfTile(const SetPlan& plan, std::uint32_t number);

/// Moves Gaussians out of a tile's splats, which keep their other attributes.
/// @param splats at least one
GaussianCloud takeGaussians(const TileSet& set, const TileKey& tile, TileSplats& splats);

/// Even samples of a capture that is read in batches, for its up direction.
class GaussianSample {
public:
    void add(const Cloud& batch, const std::vector<Vec3d>& positions);

    std::uint64_t gaussians() const { return gaussians_; }
    /// The surface of the sampled Gaussians that are opaque (gaussian_surface.h).
    Splats surface(const Vec3d& origin) const;

private:
    struct Row {
        Vec3d position;
        float opacity;
        std::array<float, 3> deviation;
        std::array<float, 4> rotation;
    };

    std::vector<Row> rows_;
    std::uint64_t step_ = 1, gaussians_ = 0;
};

} // namespace pointrt
