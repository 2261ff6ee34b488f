// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/measure_traits.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "format/base/error.h"
#include "preprocess/cloud/clean_noise.h"
#include "preprocess/cloud/keep_flagged.h"
#include "preprocess/cloud/median.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/tiles/buckets.h"
#include "preprocess/tiles/measure_reach.h"

namespace pointrt {
namespace {

/// So many places, of so many points at the most.
struct Sampling {
    std::uint64_t places, points;
};

/// Takes three seconds, and the median of these places is that of a scan of even noise.
constexpr Sampling kNoiseSampling{8, 20'000};

/// What is a share or a quantile of all points needs more places; without cleaning that takes half a second.
constexpr Sampling kOtherSampling{32, 6'000};

/// One of several that share a tile's points in the order read.
struct Place {
    std::uint32_t tile = 0;
    std::uint64_t number = 0, of = 1;
};

/// A part of a cloud, and which of its points have all their surroundings there.
struct CutCloud {
    Cloud cloud;
    std::vector<std::uint8_t> inner;
};

/// The box of a place.
struct Box {
    Vec3f middle;
    float reach = 0; ///< to its faces

    float reachOf(const Vec3f& position) const { return (position - middle).cwiseAbs().maxCoeff(); }
};

/// Around one of the points, so that it holds so many.
Box boxOf(const Cloud& bucket, const Place& place, std::size_t count) {
    Box box{bucket.positions[(2 * place.number + 1) * bucket.positions.size() / (2 * place.of)],
            std::numeric_limits<float>::infinity()};
    if (count >= bucket.positions.size()) return box;
    std::vector<float> reaches(bucket.positions.size());
    std::transform(bucket.positions.begin(), bucket.positions.end(), reaches.begin(),
                   [&](const Vec3f& position) { return box.reachOf(position); });
    const auto farthest = reaches.begin() + std::ptrdiff_t(count);
    std::nth_element(reaches.begin(), farthest, reaches.end());
    box.reach = *farthest;
    return box;
}

/// A place's positions and scans, of a bucket's. Nothing moves, so that scans stay runs. A tenth of a place's width are
/// eight spacings of 6,000 points on a surface, and neighbours are within three.
CutCloud cut(const Cloud& bucket, const Place& place, std::size_t count) {
    constexpr float kInner = 0.8f;
    const Box box = boxOf(bucket, place, count);
    std::vector<bool> keep;
    CutCloud part;
    for (const Vec3f& position : bucket.positions) {
        const float reach = box.reachOf(position);
        keep.push_back(reach < box.reach);
        if (keep.back()) part.inner.push_back(reach < kInner * box.reach);
    }
    part.cloud = bucket;
    std::size_t point = 0, kept = 0;
    for (Scan& scan : part.cloud.scans) {
        for (; point < scan.first_point; ++point) kept += keep[point];
        scan.first_point = kept;
    }
    keepFlagged(part.cloud.positions, keep);
    keepFlagged(part.cloud.normals, keep);
    keepFlagged(part.cloud.radii, keep);
    return part;
}

/// Points of each scan.
std::vector<std::size_t> countsOf(const Cloud& cloud) {
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < cloud.scans.size(); ++i)
        counts.push_back((i + 1 < cloud.scans.size() ? cloud.scans[i + 1].first_point : cloud.positions.size()) -
                         cloud.scans[i].first_point);
    return counts;
}

/// Hears of places. A place without a surface tells nothing.
using PlaceHeard = std::function<void(const SurfaceReport&, const Splats&, const std::vector<std::size_t>& counts)>;

void measurePlace(CutCloud&& part, const SurfaceOptions& options, std::optional<float> common_reach,
                  const PlaceHeard& heard) {
    const std::vector<std::size_t> counts = countsOf(part.cloud);
    SurfaceDecisions decided;
    decided.inner = std::move(part.inner);
    decided.traits.radius_limit = std::numeric_limits<float>::infinity();
    decided.traits.common_reach = common_reach;
    SurfaceReport report;
    try {
        const Splats splats = estimateSplats(std::move(part.cloud), options, report, {}, decided);
        heard(report, splats, counts);
    } catch (const Error&) {
    }
}

/// In the tiles that hold every so manieth point; in each so many as there are points for.
std::vector<Place> placesOf(const SetPlan& plan, const Sampling& sampling) {
    std::vector<Place> places;
    std::uint64_t before = 0;
    for (std::uint32_t tile = 0; tile < plan.tiles.size(); ++tile) {
        const auto until = [&](std::uint64_t points) {
            return (2 * sampling.places * points + plan.points) / (2 * plan.points);
        };
        const std::uint64_t points = plan.tiles[tile].points, after = before + points;
        const std::uint64_t count = std::min(until(after) - until(before), (points - 1) / sampling.points + 1);
        for (std::uint64_t k = 0; k < count; ++k) places.push_back({tile, k, count});
        before = after;
    }
    return places;
}

/// Of a set whose points reach so far.
void measurePlaces(const SetPlan& plan, const Sampling& sampling, SurfaceOptions options,
                   std::optional<float> common_reach, const PlaceHeard& heard) {
    options.orient = OrientMode::kUp; // sides do not matter to what is measured
    options.radius_scale = 1;
    Cloud bucket;
    for (const Place& place : placesOf(plan, sampling)) {
        if (place.number == 0) {
            bucket = readBucket(plan, place.tile);
            bucket.colors.clear();
            bucket.sensor_of_point.clear();
            bucket.attributes.clear();
        }
        measurePlace(cut(bucket, place, sampling.points), options, common_reach, heard);
    }
}

/// Of what places tell of each scan.
std::vector<float> noiseOf(const std::vector<std::vector<float>>& of_scan) {
    std::vector<float> all, noise;
    for (const std::vector<float>& values : of_scan) all.insert(all.end(), values.begin(), values.end());
    if (all.empty()) return {};
    const float usual = medianOf(all);
    for (const std::vector<float>& values : of_scan) noise.push_back(values.empty() ? usual : medianOf(values));
    return noise;
}

std::vector<float> measureNoise(const SetPlan& plan, std::optional<float> common_reach) {
    std::vector<std::vector<float>> of_scan(plan.scans.size());
    measurePlaces(plan, kNoiseSampling, plan.bake.surface, common_reach,
                  [&](const SurfaceReport& report, auto&, const auto& counts) {
                      for (std::size_t scan = 0; scan < report.noise.size(); ++scan)
                          if (counts[scan] >= kFewForNoise) of_scan[scan].push_back(report.noise[scan]);
                  });
    return noiseOf(of_scan);
}

} // namespace

CloudTraits measureTraits(const SetPlan& plan) {
    SurfaceOptions options = plan.bake.surface;
    const std::optional<float> common_reach = options.remove_outliers ? measureReach(plan) : std::nullopt;
    options.clean = 0;
    PlacesOfCloud places;
    measurePlaces(plan, kOtherSampling, options, common_reach,
                  [&](const SurfaceReport& report, const Splats& splats, auto&) { places.add(report, splats); });
    CloudTraits traits = places.traits();
    traits.common_reach = common_reach;
    // places miss where the widest are; where none brings its own radius the radii of all will tell (widest_radius.h)
    if (!plan.schema.radii) traits.radius_limit = std::numeric_limits<float>::max();
    if (plan.bake.surface.clean > 0) traits.noise = measureNoise(plan, common_reach);
    return traits;
}

} // namespace pointrt
