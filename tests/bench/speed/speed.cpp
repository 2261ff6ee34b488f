// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/speed.h"

#include <algorithm>
#include <cmath>

#include "tests/support/first_hit_check.h"

namespace pointrt::test {

namespace {

/// The median of values, which must not be empty: for an even number the mean of the middle two.
double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

/// Seconds of one run.
struct Turn {
    double ours = 0, single = 0, packets = 0;
    double blending = 0; ///< after ours
    double embree() const { return std::min(single, packets); }
    double ratio() const { return embree() / ours; }
    double blendedRatio() const { return embree() / (ours + blending); }
};

class Contest {
public:
    Contest(RayCaster& caster, const EmbreeDiscs& discs, std::span<const Ray> rays, RayKind kind)
        : caster_(caster), discs_(discs), rays_(rays), any_hit_(kind == RayKind::kShadow),
          coherent_(kind == RayKind::kPrimary || kind == RayKind::kShadow), camera_(kind == RayKind::kPrimary) {
        if (!camera_) caster_.load(rays_);
    }

    Turn turn() {
        Turn times;
        times.ours = camera_ ? caster_.traceCamera() : caster_.traceLoaded(any_hit_);
        times.single = embree(EmbreeMode::kSingle).seconds;
        times.packets = embree(EmbreeMode::kPackets).seconds;
        if (camera_) caster_.load(rays_); // keeps the hits of these rays
        if (!any_hit_) times.blending = caster_.blendHits();
        return times;
    }

    /// Our hits in the last turn.
    std::vector<CastHit> ourHits() { return camera_ ? caster_.cameraHits() : caster_.loadedHits(); }
    std::vector<EmbreeHit> embreeHits() const { return embree(EmbreeMode::kSingle).hits; }
    bool anyHit() const { return any_hit_; }

private:
    EmbreeRun embree(EmbreeMode mode) const { return runEmbree(discs_, rays_, mode, any_hit_, coherent_); }

    RayCaster& caster_;
    const EmbreeDiscs& discs_;
    std::span<const Ray> rays_;
    bool any_hit_, coherent_, camera_;
};

void compareHits(Contest& contest, std::span<const CubeSplat> splats, Speed& speed) {
    const std::vector<CastHit> ours = contest.ourHits();
    const std::vector<EmbreeHit> embrees = contest.embreeHits();
    std::size_t same = 0, hits = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        hits += ours[i].hit();
        same += contest.anyHit() ? ours[i].hit() == (embrees[i].splat != kNoSplat)
                                 : sameFirstHit(splats, ours[i], embrees[i]);
    }
    speed.agreement = static_cast<double>(same) / static_cast<double>(ours.size());
    speed.hit_share = static_cast<double>(hits) / static_cast<double>(ours.size());
}

} // namespace

bool sameFirstHit(std::span<const CubeSplat> splats, const CastHit& ours, const EmbreeHit& embrees) {
    if (ours.splat == embrees.splat) return true;
    if (!ours.hit() || embrees.splat == kNoSplat) return false;
    return std::abs(ours.t_flat - embrees.t) < kSameHitRadii * splats[ours.splat].radius;
}

Speed measureSpeed(RayCaster& caster, const EmbreeDiscs& discs, std::span<const CubeSplat> splats,
                   std::span<const Ray> rays, RayKind kind, int runs) {
    Contest contest(caster, discs, rays, kind);
    contest.turn();
    std::vector<Turn> turns;
    for (int run = 0; run < runs; ++run) turns.push_back(contest.turn());
    const double million_rays = 1e-6 * static_cast<double>(rays.size());
    const auto collect = [&](auto&& value) {
        std::vector<double> values;
        for (const Turn& turn : turns) values.push_back(value(turn));
        return values;
    };
    Speed speed{kind, rays.size()};
    speed.ours = median(collect([&](const Turn& turn) { return million_rays / turn.ours; }));
    speed.embree = median(collect([&](const Turn& turn) { return million_rays / turn.embree(); }));
    const std::vector<double> ratios = collect([](const Turn& turn) { return turn.ratio(); });
    speed.ratio = median(ratios);
    speed.ratio_min = *std::min_element(ratios.begin(), ratios.end());
    speed.ratio_max = *std::max_element(ratios.begin(), ratios.end());
    speed.ratio_blended = median(collect([](const Turn& turn) { return turn.blendedRatio(); }));
    const auto packets_won =
        std::count_if(turns.begin(), turns.end(), [](const Turn& turn) { return turn.packets < turn.single; });
    speed.embree_mode = 2 * packets_won > runs ? EmbreeMode::kPackets : EmbreeMode::kSingle;
    compareHits(contest, splats, speed);
    return speed;
}

} // namespace pointrt::test
