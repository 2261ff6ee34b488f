// SPDX-License-Identifier: Apache-2.0
#include "tests/support/first_hit_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointrt::test {

namespace {

/// One tracer's claim, and what double makes of it.
struct Claim {
    const CubeSplat* splat = nullptr; ///< nullptr: no hit
    DiscHit at;
    bool ours = false;

    /// How far rounding may move the hit, cube units.
    double error() const { return kFloatError / at.slope; }
};

Claim claimOf(std::span<const CubeSplat> splats, const Ray& ray, std::uint32_t splat, bool ours) {
    if (splat == kNoSplat) return {nullptr, {}, ours};
    return {&splats[splat], meetPlane(splats[splat], ray.origin, ray.direction), ours};
}

/// Is the order of two claimed hits open?
Verdict judgeOrder(const Claim& a, const Claim& b) {
    const double gap = std::abs(a.at.t - b.at.t), radius = std::min(a.splat->radius, b.splat->radius);
    if (gap <= kTieRadii * radius) return Verdict::kTie;
    return gap <= a.error() + b.error() ? Verdict::kRounding : Verdict::kAgree;
}

/// Why one tracer has the nearer claim and the other has not.
Verdict judgeNearer(const Claim& nearer) {
    const double off_rim = std::abs(nearer.at.share - 1);
    if (off_rim <= kRimShare) return Verdict::kRim;
    if (off_rim * nearer.splat->radius <= nearer.error()) return Verdict::kRounding;
    const bool is_hit = nearer.at.share < 1 && nearer.at.t > 0;
    return is_hit == nearer.ours ? Verdict::kEmbreeMisses : Verdict::kWeMiss;
}

} // namespace

Verdict judge(std::span<const CubeSplat> splats, const Ray& ray, const CastHit& ours, const EmbreeHit& embrees) {
    if (ours.splat == embrees.splat) return Verdict::kAgree;
    const Claim a = claimOf(splats, ray, ours.splat, true), b = claimOf(splats, ray, embrees.splat, false);
    if (!a.splat) return judgeNearer(b);
    if (!b.splat) return judgeNearer(a);
    const double radius = std::min(a.splat->radius, b.splat->radius);
    if (std::abs(ours.t_flat - embrees.t) < kSameHitRadii * radius) return Verdict::kAgree;
    const Verdict order = judgeOrder(a, b);
    return order != Verdict::kAgree ? order : judgeNearer(a.at.t < b.at.t ? a : b);
}

std::uint32_t nearestInDouble(std::span<const CubeSplat> splats, const Ray& ray, const CastHit& ours,
                              const EmbreeHit& embrees) {
    std::uint32_t best = kNoSplat;
    double t = std::numeric_limits<double>::infinity();
    for (const std::uint32_t splat : {ours.splat, embrees.splat}) {
        if (splat == kNoSplat) continue;
        const DiscHit at = meetPlane(splats[splat], ray.origin, ray.direction);
        if (at.share >= 1 || at.t <= 0 || at.t >= t) continue;
        best = splat;
        t = at.t;
    }
    return best;
}

FirstHitCheck checkFirstHits(std::span<const CubeSplat> splats, std::span<const Ray> rays,
                             std::span<const CastHit> ours, std::span<const EmbreeHit> embrees) {
    FirstHitCheck check;
    check.rays = rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check.hits += ours[i].hit();
        const Verdict verdict = judge(splats, rays[i], ours[i], embrees[i]);
        ++check.counts[static_cast<std::size_t>(verdict)];
        if (verdict == Verdict::kAgree) continue;
        check.double_is_ours += nearestInDouble(splats, rays[i], ours[i], embrees[i]) == ours[i].splat;
        if (verdict == Verdict::kWeMiss || verdict == Verdict::kEmbreeMisses) check.unexplained.push_back(i);
    }
    return check;
}

} // namespace pointrt::test
