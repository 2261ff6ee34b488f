// SPDX-License-Identifier: GPL-3.0-or-later
// A tile's own splats, as stored in its file and its neighbours'.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "preprocess/cloud/splats.h"
#include "preprocess/tiles/lattice.h"

namespace pointrt {

/// All arrays have the same length; colors and noise may be empty. A splat belongs to one tile only. Points that
/// cleaning moved across a border stay in the tile that computed them, with codes beyond the core; the neighbour reads
/// them.
struct TileSplats {
    std::vector<PositionCode> positions; ///< codes of the tile
    std::vector<std::uint32_t> normals;  ///< as normalWord returns them
    std::vector<float> radii;            ///< input units, above 0
    std::vector<Rgb8> colors;            ///< sRGB
    std::vector<float> noise;            ///< standard deviation across the surface, input units
    std::vector<Attribute> attributes;   ///< the set's attributes, in its order
    double error = 0;                    ///< input units, SetTile::error; 0: original splats
    double spacing = 0;                  ///< input units, SetTile::spacing
};

/// A view of splats.
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
    float widest = std::numeric_limits<float>::infinity(); ///< larger radii are clamped to it

    float radius(std::size_t i) const { return std::min(radii[i], widest); }
};
SplatsView viewOf(const TileSplats& splats);

/// Flag of a ball in normal words, at the place where word 2 of SPLT has the highest bit of the material row.
constexpr std::uint32_t kBallNormal = 1u << 31;

/// Word 2 of SPLT with material row 0, and kBallNormal for balls. normal: any length; 0 for a ball
std::uint32_t normalWord(const Vec3f& normal);
/// Unit length; 0 for a ball.
Vec3f normalOf(std::uint32_t word);

/// No splats, with the same schema.
TileSplats emptyLike(const TileSplats& splats);

/// Appends splat i of from, which has the same schema, at another position. If only one of the two stores noise, the
/// splats of the other get noise 0.
void appendSplat(TileSplats& to, const SplatsView& from, std::size_t i, const PositionCode& position);

/// Spacing: edge of the square per splat, median over a sample, input units; 0 for fewer than 2 splats. Positions must
/// be sorted along a Morton curve.
/// @param step input units per position step
double spacingOf(const std::vector<PositionCode>& positions, double step);

} // namespace pointrt
