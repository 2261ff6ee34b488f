// SPDX-License-Identifier: Apache-2.0
// Our first hits against Embree's, and why they differ where they do, recomputed in double.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tests/support/embree_discs.h"
#include "tests/support/ray_caster.h"

namespace pointrt::test {

/// Hits this near, in local radii, are the same whichever splat is named.
constexpr double kSameHitRadii = 1e-4;
/// A hit within this share of the radius from the rim may fall to either side of it.
constexpr double kRimShare = 1e-4;
/// Two hits within this many radii may be met in either order.
constexpr double kTieRadii = 1e-5;
/// Where a ray meets a plane is off by up to this over the slope, in cube units: four roundings (difference, product,
/// sum, quotient) by half a last place, 2^-24, of distances between 1 and 2.
constexpr double kFloatError = 0x1p-22;

enum class Verdict {
    kAgree,        ///< the same splat, the same distance, or no hit in both
    kRim,          ///< the disputed hit is at its disc's rim
    kTie,          ///< both hits are as near
    kRounding,     ///< the discs are so small or the ray is so flat over them that rounding decides on rim or order
    kWeMiss,       ///< unexplained: a clear hit that only Embree has, or one of ours that is none
    kEmbreeMisses, ///< unexplained: the other way round
};
constexpr std::size_t kVerdicts = 6;

/// The verdict on one ray.
Verdict judge(std::span<const CubeSplat> splats, const Ray& ray, const CastHit& ours, const EmbreeHit& embrees);

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
FirstHitCheck checkFirstHits(std::span<const CubeSplat> splats, std::span<const Ray> rays,
                             std::span<const CastHit> ours, std::span<const EmbreeHit> embrees);

} // namespace pointrt::test
