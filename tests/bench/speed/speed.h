// SPDX-License-Identifier: Apache-2.0
// Compares the speed of our tracer with Embree's oriented discs: the same rays, alternately.
#pragma once

#include <span>
#include <vector>

#include "tests/bench/speed/embree_batch.h"
#include "tests/bench/speed/ray_kinds.h"

namespace pointrt::test {

/// Results for one kind of ray. Rates are medians over the runs in million rays per second; ratio: ours over Embree's.
struct Speed {
    RayKind kind = RayKind::kPrimary;
    std::size_t rays = 0;
    double hit_share = 0; ///< of our rays
    double ours = 0, embree = 0;
    double ratio = 0, ratio_min = 0, ratio_max = 0; ///< median, least and largest over the runs
    double ratio_blended = 0;                       ///< median, with the surfaces at our first hits blended
    double agreement = 0;                           ///< share of rays with the same result, by sameFirstHit, or any hit
    EmbreeMode embree_mode = EmbreeMode::kSingle;   ///< the faster one in most runs
};

/// Whether two first hits are the same: no hit in both, the same splat, or within kSameHitRadii of our hit's disc.
bool sameFirstHit(std::span<const CubeSplat> splats, const CastHit& ours, const EmbreeHit& embrees);

/// Times rays (not empty, at most the caster's batch) with our tracer, Embree's single rays, Embree's packets of 8, and
/// our tracer with blended surfaces, which Embree does not have: all in turn, once as a warm-up and then runs times. In
/// each run, the faster of Embree's two modes counts.
Speed measureSpeed(RayCaster& caster, const EmbreeDiscs& discs, std::span<const CubeSplat> splats,
                   std::span<const Ray> rays, RayKind kind, int runs);

} // namespace pointrt::test
