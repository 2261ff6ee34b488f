// SPDX-License-Identifier: Apache-2.0
// Compares our closest hits with those of Embree, and explains differences by recomputing in double.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/embree_discs.h"
#include "tests/support/ray_caster.h"

namespace pointrt::test {

// Rays are tested against near splats (pointrt/pro_index_layout.h); these constants bound their quantization. The
// distance to the chosen disc is exact. Float errors of Embree and of that distance are much smaller: kFloatError.

/// Bound of the error of the radius, in radii: half a step of 2^-5 of its square, halved by the root.
constexpr double kNearRadius = 0x1p-7;
/// Bound of the angle error of the normal, in radians: the largest component is exact, at 127 codes; the other two are
/// off by half a code each.
constexpr double kNearNormal = std::numbers::sqrt2 / 2 / 127;
/// Bound of the error of the centre, as a share of the reach of 511 codes: one code per axis. The smallest radius,
/// 2^-6.5 codes, adds the growth of smaller discs; codes are up to a seventeenth too few, because they are rounded down
/// to a multiple of a sixteenth of a power of two.
constexpr double kNearPosition = (std::numbers::sqrt3 + 0.0111) / 511 * 17 / 16;
/// The same along the normal of the disc, which quantization minimizes first (CellCodec.KeepsDiscsToACode).
constexpr double kNearHeight = 0.5 / 511 * 17 / 16;
/// Discs beyond 8 cell edges are bent to that radius: rims are off by up to this share of an edge
/// (format/index/cell_codec.cpp).
constexpr double kNearLargest = 8, kNearLargeRim = 3.0 / 64;

/// Bound of the error of the intersection of a ray with a plane, times the slope, in cube units: four roundings
/// (difference, product, sum, quotient) of half a unit in the last place, 2^-24, of distances between 1 and 2.
constexpr double kFloatError = 0x1p-22;
/// Hits within this distance, in local radii, count as equal whichever splat is reported. In even scenes, with cells of
/// 1.7 radii and reaches of 4.3, quantization moves a disc along its normal by up to kNearNormal + 2 * 4.3 kNearHeight
/// radii, 0.015, so the order of two such discs is undefined.
constexpr double kSameHitRadii = 0.015;

/// Parameters of a scene that quantization depends on, in cube units.
struct NearRounding {
    double position = 0;  ///< bound of the error of a near splat's centre
    double height = 0;    ///< along the normal of its disc
    double cell_edge = 0; ///< of the largest cells
};

/// cell_edge: RayCaster::cellEdge.
NearRounding nearRounding(std::span<const CubeSplat> splats, double cell_edge);

enum class Verdict {
    kAgree,        ///< the same splat, the same distance, or no hit in both
    kRim,          ///< the disputed hit is within the rounding error of its disc's rim
    kTie,          ///< the distance of both hits is within the rounding error of their planes
    kRounding,     ///< the same, beyond those bounds: the ray grazes the disc
    kWeMiss,       ///< unexplained: a clear hit that only Embree reports, or a false hit of ours
    kEmbreeMisses, ///< unexplained: the reverse
};
constexpr std::size_t kVerdicts = 6;

/// The verdict on one ray.
Verdict judge(std::span<const CubeSplat> splats, const NearRounding& rounding, const Ray& ray, const CastHit& ours,
              const EmbreeHit& embrees);

/// Whether the closest hit may be at t (nullopt: a miss) within rounding errors, where t must be the exact distance of
/// some disc. Tests every disc in double, without a hierarchy or another tracer.
bool mayBeFirst(std::span<const CubeSplat> splats, const NearRounding& rounding, const Ray& ray,
                std::optional<double> t);

/// Which of our splat and Embree's the ray hits first, computed in double; kNoSplat if it hits neither.
std::uint32_t nearestInDouble(std::span<const CubeSplat> splats, const Ray& ray, const CastHit& ours,
                              const EmbreeHit& embrees);

struct FirstHitCheck {
    std::size_t rays = 0, hits = 0; ///< hits: ours
    std::array<std::size_t, kVerdicts> counts{};
    std::size_t double_is_ours = 0;       ///< disagreeing rays where the result in double is ours
    std::vector<std::size_t> unexplained; ///< indices of rays

    std::size_t count(Verdict verdict) const { return counts[static_cast<std::size_t>(verdict)]; }
    double agreement() const { return static_cast<double>(count(Verdict::kAgree)) / static_cast<double>(rays); }
};

/// ours and embrees are the hits of rays. All must have the same length, not 0.
FirstHitCheck checkFirstHits(std::span<const CubeSplat> splats, const NearRounding& rounding, std::span<const Ray> rays,
                             std::span<const CastHit> ours, std::span<const EmbreeHit> embrees);

} // namespace pointrt::test
