// SPDX-License-Identifier: GPL-3.0-or-later
// The splats that a tile has computed, as its own file and its neighbours' will hold them.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "preprocess/cloud/splats.h"
#include "preprocess/tiles/lattice.h"

namespace pointrt {

/// All arrays have one length; colors and noise may be empty. A splat stands in one tile's only. Points that cleaning
/// moved across a border stay where they were computed: their codes lie beyond the core, and the neighbour takes them.
struct TileSplats {
    std::vector<PositionCode> positions; ///< seen from the tile
    std::vector<std::uint32_t> normals;  ///< as word 2 of SPLT
    std::vector<float> radii;            ///< input units, above 0
    std::vector<Rgb8> colors;            ///< sRGB
    std::vector<float> noise;            ///< standard deviation across the surface, input units
    std::vector<Attribute> attributes;   ///< those of the set, in its order
    double error = 0;                    ///< input units, SetTile::error; 0: original splats
    double spacing = 0;                  ///< input units, SetTile::spacing
};

/// The same, of somebody's memory.
struct SplatsView {
    std::span<const PositionCode> positions;
    std::span<const std::uint32_t> normals;
    std::span<const float> radii;
    std::span<const Rgb8> colors;
    std::span<const float> noise;
    struct Values {
        const char* data;
        std::size_t bytes_each;
    };
    std::vector<Values> attributes;
    float widest = std::numeric_limits<float>::infinity(); ///< radii above it count as this

    float radius(std::size_t i) const { return std::min(radii[i], widest); }
};
SplatsView viewOf(const TileSplats& splats);

/// Word 2 of SPLT of material row 0. normal: any length.
std::uint32_t normalWord(const Vec3f& normal);
/// Unit length.
Vec3f normalOf(std::uint32_t word);

/// Empty arrays with the schema of others.
TileSplats emptyLike(const TileSplats& splats);

/// Appends splat i of a view with the same schema, at a position of its own. Where only one of the two knows noise, it
/// is 0 in the other.
void appendSplat(TileSplats& to, const SplatsView& from, std::size_t i, const PositionCode& position);

/// Edge of the square that a splat has to itself, the median of a sample of them, input units; 0 of fewer than 2.
/// Positions stand along a Morton curve.
/// @param step input units to a position step
double spacingOf(const std::vector<PositionCode>& positions, double step);

} // namespace pointrt
