// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/measure_statistics.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "format/base/error.h"
#include "preprocess/cloud/clean_noise.h"
#include "preprocess/cloud/keep_flagged.h"
#include "preprocess/cloud/median.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/tiles/buckets.h"
#include "preprocess/tiles/measure_neighbor_distance.h"

namespace pointrt {
namespace {

/// The number of places to measure, and the most points of a place.
struct Sampling {
    std::uint64_t places, points;
};

/// Places for the noise. They take three seconds, and suffice if the noise is the same throughout a scan.
constexpr Sampling kNoiseSampling{8, 20'000};

/// Places for the other statistics. Shares and quantiles of all points need more of them; as they are not cleaned, they
/// take half a second.
constexpr Sampling kOtherSampling{32, 6'000};

/// A place to measure: the surroundings of one point. A tile's places (`of` of them) are at even steps along its points
/// in reading order.
struct Place {
    std::uint32_t tile = 0;
    std::uint64_t number = 0, of = 1;
};

/// A part of a cloud; inner flags the points whose neighbours are all in it.
struct CutCloud {
    Cloud cloud;
    std::vector<std::uint8_t> inner;
};

/// A cube around a point.
struct Box {
    Vec3f middle;
    float half_edge = 0;

    float distanceTo(const Vec3f& position) const { return (position - middle).cwiseAbs().maxCoeff(); }
};

/// The cube around the point of a place that holds `count` points, or all if there are no more.
Box boxOf(const Cloud& bucket, const Place& place, std::size_t count) {
    Box box{bucket.positions[(2 * place.number + 1) * bucket.positions.size() / (2 * place.of)],
            std::numeric_limits<float>::infinity()};
    if (count >= bucket.positions.size()) return box;
    std::vector<float> distances(bucket.positions.size());
    std::transform(bucket.positions.begin(), bucket.positions.end(), distances.begin(),
                   [&](const Vec3f& position) { return box.distanceTo(position); });
    const auto farthest = distances.begin() + std::ptrdiff_t(count);
    std::nth_element(distances.begin(), farthest, distances.end());
    box.half_edge = *farthest;
    return box;
}

/// The points of a place, in their order, so that scans stay consecutive. Inner points are at least a tenth of the
/// cube's width from its faces: for 6,000 points on a surface that is eight spacings, and neighbours are within three.
CutCloud cut(const Cloud& bucket, const Place& place, std::size_t count) {
    constexpr float kInner = 0.8f;
    const Box box = boxOf(bucket, place, count);
    std::vector<bool> keep;
    CutCloud part;
    for (const Vec3f& position : bucket.positions) {
        const float distance = box.distanceTo(position);
        keep.push_back(distance < box.half_edge);
        if (keep.back()) part.inner.push_back(distance < kInner * box.half_edge);
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

/// Number of points of each scan.
std::vector<std::size_t> countsOf(const Cloud& cloud) {
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < cloud.scans.size(); ++i)
        counts.push_back((i + 1 < cloud.scans.size() ? cloud.scans[i + 1].first_point : cloud.positions.size()) -
                         cloud.scans[i].first_point);
    return counts;
}

/// Receives the results of each place that has a surface.
using PlaceResult = std::function<void(const SurfaceReport&, const Splats&, const std::vector<std::size_t>& counts)>;

void measurePlace(CutCloud&& part, const SurfaceOptions& options, std::optional<float> common_reach,
                  const PlaceResult& result) {
    const std::vector<std::size_t> counts = countsOf(part.cloud);
    SurfaceDecisions decided;
    decided.inner = std::move(part.inner);
    decided.statistics.radius_limit = std::numeric_limits<float>::infinity();
    decided.statistics.common_reach = common_reach;
    SurfaceReport report;
    try {
        const Splats splats = estimateSplats(std::move(part.cloud), options, report, {}, decided);
        result(report, splats, counts);
    } catch (const Error&) {
    }
}

/// Distributes the places over the tiles in proportion to their points, but at most one place for each
/// sampling.points points of a tile.
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

/// Measures all places. common_reach: see CloudStatistics.
void measurePlaces(const SetPlan& plan, const Sampling& sampling, SurfaceOptions options,
                   std::optional<float> common_reach, const PlaceResult& result) {
    options.orient = OrientMode::kUp;  // sides do not affect these statistics
    options.splat = SplatShape::kDisc; // nor do balls
    options.radius_scale = 1;
    Cloud bucket;
    for (const Place& place : placesOf(plan, sampling)) {
        if (place.number == 0) {
            bucket = readBucket(plan, place.tile);
            bucket.colors.clear();
            bucket.sensor_of_point.clear();
            bucket.attributes.clear();
        }
        measurePlace(cut(bucket, place, sampling.points), options, common_reach, result);
    }
}

/// The noise of each scan: the median of its places, or the median of all places if it has none.
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

CloudStatistics measureStatistics(const SetPlan& plan) {
    SurfaceOptions options = plan.bake.surface;
    const std::optional<float> common_reach = options.remove_outliers ? measureNeighborDistance(plan) : std::nullopt;
    options.clean = 0;
    StatisticsSampler places;
    measurePlaces(plan, kOtherSampling, options, common_reach,
                  [&](const SurfaceReport& report, const Splats& splats, auto&) { places.add(report, splats); });
    CloudStatistics statistics = places.statistics();
    statistics.common_reach = common_reach;
    // the places miss the widest discs: unless the input gives radii, widest_radius.h finds the limit from all discs
    if (!plan.schema.radii) statistics.radius_limit = std::numeric_limits<float>::max();
    if (plan.bake.surface.clean > 0) statistics.noise = measureNoise(plan, common_reach);
    return statistics;
}

} // namespace pointrt
