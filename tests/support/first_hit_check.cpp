// SPDX-License-Identifier: Apache-2.0
#include "tests/support/first_hit_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pointrt/pro.h"

#include "pointrt/pro_index_layout.h"

namespace pointrt::test {

namespace {

/// Intersection of a ray with a disc in double, and the bound of its rounding error, cube units.
struct Meeting {
    DiscHit at;
    double off_rim = 0;  ///< inwards
    double rim = 0;      ///< the rim moves by this
    double height = 0;   ///< the plane moves by this at the intersection
    double along = 0;    ///< the ray's hit by this, along the ray
    double sideways = 0; ///< and by this towards the rim or away

    bool surelyHit() const { return off_rim > rim + sideways && at.t > along; }
    bool surelyMissed() const { return -off_rim > rim + sideways || at.t < -along; }
};

Meeting meet(const CubeSplat& splat, const NearRounding& rounding, const Ray& ray) {
    Meeting m;
    m.at = meetPlane(splat, ray.origin, ray.direction);
    const double radius = splat.radius, bent = radius > kNearLargest * rounding.cell_edge ? kNearLargeRim : 0;
    m.off_rim = (1 - m.at.share) * radius;
    m.rim = kFloatError + rounding.position + kNearRadius * radius + bent * rounding.cell_edge;
    m.height = kFloatError + rounding.height + kNearNormal * std::max(m.at.share, 1.0) * radius;
    const double least_slope = m.at.slope - kNearNormal;
    m.along = least_slope > 0 ? m.height / least_slope : std::numeric_limits<double>::infinity();
    // the component of a step along the ray in the plane, whose normal is quantized, as is the path there
    m.sideways = m.along * std::min(1.0, std::sqrt(std::max(0.0, 1 - m.at.slope * m.at.slope)) + 2 * kNearNormal);
    return m;
}

/// A hit reported by a tracer, with its check in double.
struct Claim {
    const CubeSplat* splat = nullptr; ///< nullptr: no hit
    Meeting meeting;
    bool ours = false;
};

/// Whether the order of two hits is undefined within rounding.
Verdict judgeOrder(const Meeting& a, const Meeting& b) {
    const double gap = std::abs(a.at.t - b.at.t);
    if (gap <= a.height + b.height) return Verdict::kTie;
    return gap <= a.along + b.along ? Verdict::kRounding : Verdict::kAgree;
}

/// Why only one tracer reports the nearer hit.
Verdict judgeNearer(const Claim& nearer) {
    const Meeting& m = nearer.meeting;
    if (std::abs(m.off_rim) <= m.rim) return Verdict::kRim;
    if (!m.surelyHit() && !m.surelyMissed()) return Verdict::kRounding;
    return m.surelyHit() == nearer.ours ? Verdict::kEmbreeMisses : Verdict::kWeMiss;
}

} // namespace

NearRounding nearRounding(std::span<const CubeSplat> splats, double cell_edge) {
    double radius = 0;
    for (const CubeSplat& splat : splats) radius = std::max(radius, splat.radius);
    // near splats are relative to the centre of their block, a brick at most; the centre of a disc is at most its
    // radius beyond that, enlarged by the slack (format/index/cell_runs.cpp, bricks.cpp)
    const double slack = std::max(1e-3 * cell_edge, 1.5 * PRO_POSITION_STEP), edge = PRO_BRICK_SIDE * cell_edge;
    const double reach = 0.5 * edge + slack + std::min(radius, kNearLargest * edge);
    return {kNearPosition * reach, kNearHeight * reach, cell_edge};
}

Verdict judge(std::span<const CubeSplat> splats, const NearRounding& rounding, const Ray& ray, const CastHit& ours,
              const EmbreeHit& embrees) {
    if (ours.splat == embrees.splat) return Verdict::kAgree;
    const auto claimOf = [&](std::uint32_t splat, bool is_ours) {
        return splat == kNoSplat ? Claim{nullptr, {}, is_ours}
                                 : Claim{&splats[splat], meet(splats[splat], rounding, ray), is_ours};
    };
    const Claim a = claimOf(ours.splat, true), b = claimOf(embrees.splat, false);
    if (!a.splat) return judgeNearer(b);
    if (!b.splat) return judgeNearer(a);
    const double radius = std::min(a.splat->radius, b.splat->radius);
    if (std::abs(ours.t_flat - embrees.t) < kSameHitRadii * radius) return Verdict::kAgree;
    const Verdict order = judgeOrder(a.meeting, b.meeting);
    return order != Verdict::kAgree ? order : judgeNearer(a.meeting.at.t < b.meeting.at.t ? a : b);
}

bool mayBeFirst(std::span<const CubeSplat> splats, const NearRounding& rounding, const Ray& ray,
                std::optional<double> t) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    // the smallest distance at which a disc hit at t may have been computed
    double soonest = kInfinity, surely_before = kInfinity;
    for (const CubeSplat& splat : splats) {
        const Meeting m = meet(splat, rounding, ray);
        if (m.surelyHit()) surely_before = std::min(surely_before, m.at.t + m.along);
        if (!t || m.surelyMissed()) continue;
        // hits that quantization moves by more than a radius have no exact distance (exactDistance in
        // shaders/trace/splat.glsl)
        const double exactly = kFloatError * (1 + *t) / m.at.slope;
        if (std::abs(m.at.t - *t) <= (m.along < splat.radius ? exactly : m.along))
            soonest = std::min(soonest, m.at.t - m.along);
    }
    return t ? soonest < kInfinity && soonest <= surely_before : surely_before == kInfinity;
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

FirstHitCheck checkFirstHits(std::span<const CubeSplat> splats, const NearRounding& rounding, std::span<const Ray> rays,
                             std::span<const CastHit> ours, std::span<const EmbreeHit> embrees) {
    FirstHitCheck check;
    check.rays = rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check.hits += ours[i].hit();
        const Verdict verdict = judge(splats, rounding, rays[i], ours[i], embrees[i]);
        ++check.counts[static_cast<std::size_t>(verdict)];
        if (verdict == Verdict::kAgree) continue;
        check.double_is_ours += nearestInDouble(splats, rays[i], ours[i], embrees[i]) == ours[i].splat;
        if (verdict == Verdict::kWeMiss || verdict == Verdict::kEmbreeMisses) check.unexplained.push_back(i);
    }
    return check;
}

} // namespace pointrt::test
