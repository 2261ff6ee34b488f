// SPDX-License-Identifier: GPL-3.0-or-later
// Quantises splats to the words of the file: the cube, 21-bit positions, Morton order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pointrt/pro.h"
#include "preprocess/cloud/splats.h"

namespace pointrt {

/// A splat as readers decode it, in cube units; the octree is built from these.
struct Disc {
    Vec3f center;
    Vec3f normal; ///< unit length; 0: it is a ball
    float radius;

    bool isBall() const { return normal.isZero(0); }
};

/// Splats in Morton order of their quantised positions; all arrays have the same length.
struct PackedSplats {
    pro_info frame{}; ///< only origin, scale, bounds, radius coding, flags and blend slab are set
    std::vector<std::array<std::uint32_t, PRO_SPLAT_WORDS>> words;
    std::vector<Disc> discs;
    std::vector<Rgb8> colors;               ///< sRGB, or empty
    std::vector<std::uint64_t> morton;      ///< codes of the positions (preprocess/cloud/morton.h)
    std::vector<std::uint32_t> input_index; ///< in the cloud as read
    std::uint32_t input_count = 0;          ///< Splats::input_count
    std::vector<std::uint32_t> filled_from; ///< Splats::filled_from
    std::uint32_t filled = 0;               ///< splats that fill gaps between points
    std::vector<std::uint8_t> noise;        ///< as in NOIS; empty if all are 0
    std::size_t merged = 0;                 ///< splats dropped because of equal quantised positions
};

/// Half the height of the slab in which splats blend, relative to the radius. Neighbours still blend on surfaces whose
/// radius of curvature is twice the splat's radius, and on scans whose noise is half of it.
constexpr float kBlendSlab = 0.5f;

/// Edge of a leaf on a typical surface, in median radii. A disc at a random position and orientation overlaps
/// 1 + 4.71 / e + 4.71 / e^2 cells with an edge of e radii on average (Steiner's formula): 1.66 at 8, 1.92 at 6, 2.47
/// at 4.
constexpr double kLeafEdgeRadii = 8.0;

/// Code c is the radius max * 2^(-c * step).
struct RadiusCoding {
    float max = 0;  ///< in the unit of the radii
    float step = 0; ///< octaves
};

/// Codes from the largest radius to the smallest one, at most 15.9 octaves. Coded radii are from the series
/// 2^(k / 2^n), so equal radii in two files or tiles stay equal if these have the
/// same n. The series of a larger n includes that of a smaller one.
RadiusCoding radiusCoding(float radius_min, float radius_max);

/// Sets element k of packed: the words of the splat, and its disc as readers decode it. A normal of 0 makes it a ball.
/// @param splat in cube units of packed.frame
void packSplat(const pro_splat& splat, std::size_t k, PackedSplats& packed);

/// The byte of NOIS. @param sigma standard deviation in input units
/// @param radius in cube units, as readers decode it
std::uint8_t noiseCode(float sigma, float radius, double scale);
/// Empties packed.noise if all of it is 0.
void dropCleanNoise(PackedSplats& packed);

/// Quantises and frees splats. The cube is centred on the discs and contains all of them. Among splats with equal
/// quantised positions, keeps the first that does not fill a gap, else the first.
PackedSplats quantizeSplats(Splats&& splats);

/// Frees the data that only building and pruning the octree need, before the index allocates memory.
void freeBuildData(PackedSplats& splats);

} // namespace pointrt
