// SPDX-License-Identifier: GPL-3.0-or-later
// Splats to the packed words of the file: the cube frame, 21-bit positions, Morton order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pointrt/pro.h"
#include "preprocess/cloud/splats.h"

namespace pointrt {

/// A splat as every reader of the file will decode it, in cube units; the octree is built on these.
struct Disc {
    Vec3f center;
    Vec3f normal; ///< unit length
    float radius;
};

/// Splats in Morton order of their quantised positions; all arrays have one length.
struct PackedSplats {
    pro_info frame{}; ///< origin, scale, bounds, radius coding, flags and blend slab are filled in
    std::vector<std::array<std::uint32_t, PRO_SPLAT_WORDS>> words;
    std::vector<Disc> discs;
    std::vector<Rgb8> colors;               ///< sRGB, or empty
    std::vector<std::uint64_t> morton;      ///< codes of the positions (preprocess/cloud/morton.h)
    std::vector<std::uint32_t> input_index; ///< in the cloud as read
    std::uint32_t input_count = 0;          ///< Splats::input_count
    std::vector<std::uint32_t> filled_from; ///< Splats::filled_from
    std::uint32_t filled = 0;               ///< splats that fill gaps between points
    std::vector<std::uint8_t> noise;        ///< as in NOIS; empty where all of it is 0
    std::size_t merged = 0;                 ///< splats dropped because another has the same quantised position
};

/// Half height of the slab in which splats blend, over the radius. Neighbours on a surface whose radius
/// of curvature is twice the splat's radius, or on scans whose noise is half of it, still blend.
constexpr float kBlendSlab = 0.5f;

/// Edge of a leaf that holds a typical surface, in median radii. A disc that falls on a grid of this edge
/// anywhere, turned any way, meets 1 + 4.71 / e + 4.71 / e^2 cells of it (Steiner's formula for a disc and a cube of e
/// radii): 1.66 at 8, 1.92 at 6, 2.47 at 4.
constexpr double kLeafEdgeRadii = 8.0;

/// Code c stands for the radius most * 2^(-c * step).
struct RadiusCoding {
    float most = 0; ///< the unit of the radii
    float step = 0; ///< octaves
};

/// Codes that reach from the largest radius to the smallest one, or 15.9 octaves at most. All radii that they stand for
/// are of one series, 2^(k / 2^n): what has the same radius in two files, or in two tiles, has the same in both once
/// coded, whatever else there is, as long as their n is the same. A larger n has the radii of a smaller one, too.
RadiusCoding radiusCoding(float radius_min, float radius_max);

/// The k-th of packed is this splat: its words, and its disc as readers will decode it. Cube units of packed.frame.
void packSplat(const pro_splat& splat, std::size_t k, PackedSplats& packed);

/// As in NOIS. sigma: input units; radius: cube units, as readers decode it.
std::uint8_t noiseCode(float sigma, float radius, double scale);
/// Leaves noise out where all of it is 0.
void dropCleanNoise(PackedSplats& packed);

/// splats is emptied. The cube is centred on the discs and holds all of them. Of splats at one quantised position the
/// first stays that does not fill a gap, or the first one.
PackedSplats quantizeSplats(Splats&& splats);

/// Frees what only building and pruning the octree need, before the index takes memory.
void freeScaffold(PackedSplats& splats);

} // namespace pointrt
