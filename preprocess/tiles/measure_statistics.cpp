// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/measure_statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "format/base/error.h"
#include "preprocess/cloud/keep_flagged.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/tiles/buckets.h"
#include "preprocess/tiles/measure_neighbor_distance.h"

namespace pointrt {
namespace {

/// The number of places to measure, and the most points of a place.
struct Sampling {
    std::uint64_t places, points;
};

/// Shares, quantiles and medians of all points need many places: with 8 of 20,000 points the noise of scans was off by
/// 5 to 12%. As nothing is cleaned there, they take two seconds.
constexpr Sampling kSampling{32, 12'000};

/// Samples of the noise from all places, enough for medians of a dozen scans.
constexpr double kNoiseSamples = 1 << 15;

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

/// The point of a place.
Vec3f middleOf(const BoxPoints& tile, const Place& place) {
    const auto in_core = std::uint64_t(std::count(tile.core.begin(), tile.core.end(), 1));
    std::uint64_t before = (2 * place.number + 1) * in_core / (2 * place.of);
    std::size_t point = 0;
    while (!tile.core[point] || before-- > 0) ++point;
    return tile.cloud.positions[point];
}

/// The cube around the point of a place that holds `count` points, or all if there are no more.
Box boxOf(const BoxPoints& tile, const Place& place, std::size_t count) {
    const std::vector<Vec3f>& positions = tile.cloud.positions;
    Box box{middleOf(tile, place), std::numeric_limits<float>::infinity()};
    if (count >= positions.size()) return box;
    std::vector<float> distances(positions.size());
    std::transform(positions.begin(), positions.end(), distances.begin(),
                   [&](const Vec3f& position) { return box.distanceTo(position); });
    const auto farthest = distances.begin() + std::ptrdiff_t(count);
    std::nth_element(distances.begin(), farthest, distances.end());
    box.half_edge = *farthest;
    return box;
}

/// The points of a place, in their order, so that scans stay consecutive. Inner points are of the tile's core and at
/// least a tenth of the cube's width from its faces: for 12,000 points on a surface that is eleven spacings, and
/// neighbours are within three.
CutCloud cut(const BoxPoints& tile, const Place& place, std::size_t count) {
    constexpr float kInner = 0.8f;
    const Box box = boxOf(tile, place, count);
    std::vector<bool> keep;
    CutCloud part;
    for (std::size_t i = 0; i < tile.core.size(); ++i) {
        const float distance = box.distanceTo(tile.cloud.positions[i]);
        keep.push_back(distance < box.half_edge);
        if (keep.back()) part.inner.push_back(tile.core[i] && distance < kInner * box.half_edge);
    }
    part.cloud = tile.cloud;
    std::size_t point = 0, kept = 0;
    for (Scan& scan : part.cloud.scans) {
        for (; point < scan.first_point; ++point) kept += keep[point];
        scan.first_point = kept;
    }
    keepFlagged(part.cloud.positions, keep);
    keepFlagged(part.cloud.normals, keep);
    keepFlagged(part.cloud.radii, keep);
    keepFlagged(part.cloud.noise, keep);
    return part;
}

/// Receives the results of each place that has a surface.
using PlaceResult = std::function<void(const SurfaceReport&, const Splats&)>;

/// Keeps this many evenly spaced samples, or all if there are no more.
void thin(surface::NoiseSamples& samples, double wanted) {
    double all = 0;
    for (const std::vector<float>& values : samples.over_spacing) all += static_cast<double>(values.size());
    const double share = wanted / std::max(all, 1.0);
    if (share >= 1) return;
    for (std::size_t scan = 0; scan < samples.over_spacing.size(); ++scan) {
        std::vector<float>& values = samples.over_spacing[scan];
        const auto kept = static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size())));
        for (std::size_t i = 0; i < kept; ++i) values[i] = values[i * values.size() / kept];
        values.resize(kept);
        samples.in_clumps[scan] =
            static_cast<std::size_t>(std::lround(share * static_cast<double>(samples.in_clumps[scan])));
    }
}

/// @param noise_samples number to keep: the place's share of those of all places
void measurePlace(CutCloud&& part, const SurfaceOptions& options, std::optional<float> common_reach,
                  double noise_samples, const PlaceResult& result) {
    SurfaceDecisions decided;
    decided.inner = std::move(part.inner);
    decided.statistics.radius_limit = std::numeric_limits<float>::infinity();
    decided.statistics.common_reach = common_reach;
    SurfaceReport report;
    try {
        const Splats splats = estimateSplats(std::move(part.cloud), options, report, {}, decided);
        thin(report.noise_samples, noise_samples);
        result(report, splats);
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

/// Measures all places. common_reach is that of CloudStatistics.
void measurePlaces(const SetPlan& plan, const Sampling& sampling, SurfaceOptions options,
                   std::optional<float> common_reach, const PlaceResult& result) {
    options.orient = OrientMode::kUp;  // sides do not affect these statistics
    options.splat = SplatShape::kDisc; // balls do not affect them either
    options.radius_scale = 1;
    BoxPoints points;
    for (const Place& place : placesOf(plan, sampling)) {
        const PlanTile& tile = plan.tiles[place.tile];
        if (place.number == 0) {
            points = readPoints(plan, place.tile, firstHalo(plan, tile));
            points.cloud.colors.clear();
            points.cloud.sensor_of_point.clear();
            points.cloud.attributes.clear();
        }
        const double share = static_cast<double>(tile.points) / static_cast<double>(place.of * plan.points);
        measurePlace(cut(points, place, sampling.points), options, common_reach, share * kNoiseSamples, result);
    }
}

} // namespace

CloudStatistics measureStatistics(const SetPlan& plan) {
    SurfaceOptions options = plan.bake.surface;
    const std::optional<float> common_reach = options.remove_outliers ? measureNeighborDistance(plan) : std::nullopt;
    options.clean = 0;
    StatisticsSampler places;
    measurePlaces(plan, kSampling, options, common_reach,
                  [&](const SurfaceReport& report, const Splats& splats) { places.add(report, splats); });
    CloudStatistics statistics = places.statistics();
    statistics.common_reach = common_reach;
    // the places miss the widest discs: unless the input gives radii, widest_radius.h finds the limit from all discs
    if (!plan.schema.radii) statistics.radius_limit = std::numeric_limits<float>::max();
    if (plan.bake.surface.clean == 0) statistics.noise.clear();
    return statistics;
}

} // namespace pointrt
