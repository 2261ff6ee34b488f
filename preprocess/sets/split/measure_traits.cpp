// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/sets/split/measure_traits.h"

#include <algorithm>
#include <limits>

#include "format/base/error.h"
#include "preprocess/cloud/keep_flagged.h"
#include "preprocess/cloud/median.h"
#include "preprocess/sets/buckets.h"
#include "preprocess/surface/estimate.h"

namespace pointrt {
namespace {

/// So many places of so many points take three seconds, and the median of them is that of a scan of even noise. Where
/// noise is not asked for fewer do.
constexpr std::uint64_t kPlaces = 8, kNoisePoints = 40'000, kOtherPoints = 10'000;
constexpr std::size_t kFewPoints = 1000; // as cleaning has it: too few to tell noise from shape

/// Halves the box around a point until it holds few enough; nothing moves, so that scans stay runs.
std::vector<bool> nearMiddle(const Cloud& cloud, float edge, std::uint64_t most) {
    const Vec3f middle = cloud.positions[cloud.positions.size() / 2];
    std::vector<bool> keep(cloud.positions.size(), true);
    std::uint64_t kept = keep.size();
    for (float reach = edge; kept > most && reach > 0; reach /= 2) {
        kept = 0;
        for (std::size_t i = 0; i < keep.size(); ++i) {
            keep[i] = (cloud.positions[i] - middle).cwiseAbs().maxCoeff() <= reach;
            kept += keep[i];
        }
    }
    return keep;
}

/// What is told by: positions, scans.
Cloud placeIn(const SetPlan& plan, std::uint32_t tile) {
    Cloud cloud = readBucket(plan, tile);
    const std::vector<bool> keep = nearMiddle(cloud, static_cast<float>(edgeOf(plan, plan.tiles[tile].level)),
                                              plan.bake.surface.clean > 0 ? kNoisePoints : kOtherPoints);
    std::size_t point = 0, kept = 0;
    for (Scan& scan : cloud.scans) {
        for (; point < scan.first_point; ++point) kept += keep[point];
        scan.first_point = kept;
    }
    keepFlagged(cloud.positions, keep);
    keepFlagged(cloud.normals, keep);
    keepFlagged(cloud.radii, keep);
    cloud.colors.clear();
    cloud.sensor_of_point.clear();
    cloud.attributes.clear();
    return cloud;
}

/// Points of each scan.
std::vector<std::size_t> countsOf(const Cloud& cloud) {
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < cloud.scans.size(); ++i)
        counts.push_back((i + 1 < cloud.scans.size() ? cloud.scans[i + 1].first_point : cloud.positions.size()) -
                         cloud.scans[i].first_point);
    return counts;
}

struct Measured {
    std::vector<std::vector<float>> noise; ///< [scans] of places
    PlacesOfCloud places;
};

/// A place without a surface tells nothing.
void measurePlace(const SetPlan& plan, std::uint32_t tile, Measured& measured) {
    Cloud cloud = placeIn(plan, tile);
    const std::vector<std::size_t> counts = countsOf(cloud);
    SurfaceOptions options = plan.bake.surface;
    options.orient = OrientMode::kUp; // sides do not matter to what is measured
    options.radius_scale = 1;
    SurfaceDecisions decided;
    decided.traits.radius_limit = std::numeric_limits<float>::infinity();
    SurfaceReport report;
    try {
        const Splats splats = estimateSplats(std::move(cloud), options, report, {}, decided);
        measured.places.add(report, splats);
    } catch (const Error&) {
        return;
    }
    for (std::size_t scan = 0; scan < report.noise.size(); ++scan)
        if (counts[scan] >= kFewPoints) measured.noise[scan].push_back(report.noise[scan]);
}

/// The tiles that hold every so manieth point, each once.
std::vector<std::uint32_t> placesOf(const SetPlan& plan) {
    std::vector<std::uint32_t> tiles;
    std::uint64_t before = 0;
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        const auto places = [&](std::uint64_t points) {
            return (2 * kPlaces * points + plan.points) / (2 * plan.points);
        };
        const std::uint64_t after = before + plan.tiles[i].points;
        if (places(after) > places(before)) tiles.push_back(i);
        before = after;
    }
    return tiles;
}

std::vector<float> noiseOf(const std::vector<std::vector<float>>& of_scan) {
    std::vector<float> all, noise;
    for (const std::vector<float>& values : of_scan) all.insert(all.end(), values.begin(), values.end());
    if (all.empty()) return {};
    const float usual = medianOf(all);
    for (const std::vector<float>& values : of_scan) noise.push_back(values.empty() ? usual : medianOf(values));
    return noise;
}

} // namespace

CloudTraits measureTraits(const SetPlan& plan) {
    Measured measured;
    measured.noise.resize(plan.scans.size());
    for (const std::uint32_t tile : placesOf(plan)) measurePlace(plan, tile, measured);
    CloudTraits traits = measured.places.traits();
    traits.noise = noiseOf(measured.noise);
    return traits;
}

} // namespace pointrt
