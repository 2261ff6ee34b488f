// SPDX-License-Identifier: Apache-2.0
// Our first hits against Embree's, and why they differ where they do, recomputed in double.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/embree_discs.h"
#include "tests/support/ray_caster.h"

namespace pointrt::test {

// Rays are tested against near splats (pointrt/pro_index_layout.h), whose rounding these bound; the distance to the
// disc that is chosen is exact again. Float errors of Embree and of that distance are much smaller: kFloatError.

/// By how much the radius may be off, in radii: its square by half a step of 2^-5, which the root halves.
constexpr double kNearRadius = 0x1p-7;
/// By what angle the normal may be turned, in radians: the largest component is exact, at 127 codes, the other two are
/// off by half a code each.
constexpr double kNearNormal = std::numbers::sqrt2 / 2 / 127;
/// How far the centre may be off, in shares of the reach that is 511 codes: a code by each axis. The smallest radius,
/// 2^-6.5 codes, adds what smaller discs grow by; codes are up to a seventeenth too few, because they are rounded down
/// to a multiple of a sixteenth of a power of two.
constexpr double kNearPosition = (std::numbers::sqrt3 + 0.0111) / 511 * 17 / 16;
/// The same across the disc, which rounding looks to first (CellCodec.KeepsDiscsToACode).
constexpr double kNearHeight = 0.5 / 511 * 17 / 16;
/// Discs beyond 8 cell edges are bent to that radius: rims are off by up to this share of an edge
/// (format/index/cell_codec.cpp).
constexpr double kNearLargest = 8, kNearLargeRim = 3.0 / 64;

/// Where a ray meets a plane is off by up to this over the slope, in cube units: four roundings (difference, product,
/// sum, quotient) by half a last place, 2^-24, of distances between 1 and 2.
constexpr double kFloatError = 0x1p-22;
/// Hits this near, in local radii, are the same whichever splat is named: in even scenes, of cells of 1.7 radii and
/// reaches of 4.3, rounding moves a disc by up to kNearNormal + 2 * 4.3 kNearHeight radii, 0.015, along its normal, so
/// which of two such discs comes first means nothing.
constexpr double kSameHitRadii = 0.015;

/// What rounding depends on of a scene, in cube units.
struct NearRounding {
    double position = 0;  ///< how far a near splat's centre may be off
    double height = 0;    ///< across its disc
    double cell_edge = 0; ///< of the largest cells
};

/// cell_edge: RayCaster::cellEdge.
NearRounding nearRounding(std::span<const CubeSplat> splats, double cell_edge);

enum class Verdict {
    kAgree,        ///< the same splat, the same distance, or no hit in both
    kRim,          ///< the disputed hit is no further from its disc's rim than rounding moves that
    kTie,          ///< both hits are no further apart than rounding moves their planes
    kRounding,     ///< rim or order again, but no nearer than that: the ray is so flat over the disc that it slides
    kWeMiss,       ///< unexplained: a clear hit that only Embree has, or one of ours that is none
    kEmbreeMisses, ///< unexplained: the other way round
};
constexpr std::size_t kVerdicts = 6;

/// The verdict on one ray.
Verdict judge(std::span<const CubeSplat> splats, const NearRounding& rounding, const Ray& ray, const CastHit& ours,
              const EmbreeHit& embrees);

/// Whether rounding lets the ray's first hit be at t, exactly that of some disc, or with nullopt be none. Every disc is
/// looked at, in double: no hierarchy and no other tracer plays a part.
bool mayBeFirst(std::span<const CubeSplat> splats, const NearRounding& rounding, const Ray& ray,
                std::optional<double> t);

/// Which of the two claimed splats double hits first, kNoSplat where it hits neither.
std::uint32_t nearestInDouble(std::span<const CubeSplat> splats, const Ray& ray, const CastHit& ours,
                              const EmbreeHit& embrees);

struct FirstHitCheck {
    std::size_t rays = 0, hits = 0; ///< hits: ours
    std::array<std::size_t, kVerdicts> counts{};
    std::size_t double_is_ours = 0;       ///< of the rays that do not agree: those where double's answer is ours
    std::vector<std::size_t> unexplained; ///< indices of rays

    std::size_t count(Verdict verdict) const { return counts[static_cast<std::size_t>(verdict)]; }
    double agreement() const { return static_cast<double>(count(Verdict::kAgree)) / static_cast<double>(rays); }
};

/// ours and embrees are the hits of rays; all of the same length, not empty.
FirstHitCheck checkFirstHits(std::span<const CubeSplat> splats, const NearRounding& rounding, std::span<const Ray> rays,
                             std::span<const CastHit> ours, std::span<const EmbreeHit> embrees);

} // namespace pointrt::test
