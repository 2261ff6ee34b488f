// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "format/base/error.h"
#include "preprocess/surface/balls.h"
#include "preprocess/surface/check.h"
#include "preprocess/surface/clean.h"
#include "preprocess/surface/fill.h"
#include "preprocess/surface/normals.h"
#include "preprocess/surface/orient.h"
#include "preprocess/surface/outliers.h"
#include "preprocess/surface/parallel_stages.h"
#include "preprocess/surface/planarity.h"
#include "preprocess/surface/point_graph.h"
#include "preprocess/surface/radii.h"
#include "preprocess/surface/sightlines.h"
#include "preprocess/surface/silhouettes.h"
#include "preprocess/surface/surround.h"

namespace pointrt {
namespace surface {
namespace {

constexpr const char* kNeighborStage = "neighbors";
constexpr const char* kRadiusStage = "radii";
constexpr double kFillShare = 0.2; ///< of the radius stage's time

/// State that all stages of one estimation share.
struct Estimation {
    const SurfaceOptions& options;
    const SurfaceDecisions& decided;
    const StageProgress& progress;
    SurfaceReport& report;
    surface::Thinning thinning{};
    float common_reach = 0; ///< input units: commonReach (outliers.h)
};

/// Converts a length from input units to the unit of the points.
std::optional<float> inPoints(const PointSet& points, const std::optional<float>& length) {
    if (!length) return std::nullopt;
    return std::ldexp(*length, -points.scale_exponent);
}

void removeOutliers(PointGraph& graph, const Estimation& job) {
    const auto common_reach = inPoints(graph.points, job.decided.statistics.common_reach);
    const std::vector<std::uint8_t> keep = flagInliers(graph.points, graph.lists, common_reach);
    job.report.outliers_removed = std::size_t(std::count(keep.begin(), keep.end(), 0));
    if (job.report.outliers_removed > 0) graph.keepAndRefit(keep);
}

void surround(PointGraph& graph, const Estimation& job, const StageShare& share) {
    if (!job.thinning.replaces_lists) return share.report(1);
    Thinning thinning = job.thinning;
    thinning.finest_cells = *inPoints(graph.points, thinning.finest_cells);
    surroundNeighborhoods(graph.lists, graph.points, *graph.search, thinning, share);
}

/// [points] SurfaceDecisions::inner
std::vector<std::uint8_t> innerOf(const PointSet& points, const SurfaceDecisions& decided) {
    std::vector<std::uint8_t> inner(points.size(), 1);
    for (std::size_t i = 0; i < inner.size() && !decided.inner.empty(); ++i)
        inner[i] = decided.inner[points.input_index[i]];
    return inner;
}

/// The commonReach of the larger cloud, else that of this one; the lists must be of nearest neighbours.
float commonReachOf(const PointGraph& graph, const SurfaceDecisions& decided) {
    if (const auto reach = inPoints(graph.points, decided.statistics.common_reach)) return *reach;
    std::vector<float> distances(graph.points.size());
    const StageProgress silent;
    forEach(distances.size(), {silent, ""}, [&](std::size_t i) { distances[i] = graph.lists.radius(graph.points, i); });
    return commonReach(std::move(distances));
}

/// In clouds of fewer points, neighbourhoods may be as wide as parts of an object (balls.cpp): what looks like noise or
/// a gap is shape.
constexpr std::size_t kFewForBlur = 5000;

/// Finds the neighbours of all points, removes outliers, and sets the thinning.
void connect(PointGraph& graph, Estimation& job) {
    const Stopwatch watch(job.report.seconds_neighbors);
    constexpr double kSearch = 0.9; // of the stage's time
    graph.connect(std::size_t(job.options.neighbors), {job.progress, kNeighborStage, 0, kSearch});
    job.common_reach = std::ldexp(commonReachOf(graph, job.decided), graph.points.scale_exponent);
    const std::optional<Thinning>& decided = job.decided.statistics.thinning;
    if (!decided)
        countUnsurrounded(graph.lists, graph.points, *graph.search, innerOf(graph.points, job.decided),
                          job.report.surround);
    job.thinning = decided ? *decided : thinningOf(job.report.surround);
    if (!decided && graph.points.size() < kFewForBlur) job.thinning.is_noisy = job.thinning.has_gaps = false;
    if (job.options.remove_outliers) removeOutliers(graph, job);
    surround(graph, job, {job.progress, kNeighborStage, kSearch, 1});
}

/// Flips normals to the decided sides. Leaves a normal that is nearly perpendicular to its decided side, which was
/// decided for a wide neighbourhood whose normal may differ by that much.
void faceDecidedSides(PointSet& points, const std::vector<Vec3f>& sides) {
    constexpr float kGrazing = 0.3f; // cosine of 73 degrees
    for (std::size_t i = 0; i < points.size() && !sides.empty(); ++i) {
        const float cosine = points.normals[i].dot(sides[points.input_index[i]]);
        if (std::abs(cosine) < kGrazing || points.side_known[i]) continue;
        if (cosine < 0) points.normals[i] = -points.normals[i];
        points.side_known[i] = 1;
    }
}

/// Estimates and orients normals. Returns whether they are oriented.
bool setNormals(PointGraph& graph, bool given_sides, const Estimation& job) {
    PointSet& points = graph.points;
    {
        const Stopwatch watch(job.report.seconds_normals);
        fillNormals(graph, job.options.normals, job.progress);
        job.report.normals_estimated = std::size_t(std::count(points.side_known.begin(), points.side_known.end(), 0));
    }
    if (!given_sides) std::fill(points.side_known.begin(), points.side_known.end(), std::uint8_t{0});
    faceDecidedSides(points, job.decided.sides);
    const Stopwatch watch(job.report.seconds_orient);
    const OrientReport report = orientNormals(graph, job.options.orient, job.progress);
    job.report.normals_flipped = report.flipped;
    points.side_known = {};
    return report.oriented;
}

/// Facts about the points that are known from the cloud's scans before estimation.
struct ScanPriors {
    std::vector<std::size_t> first_points; ///< [scans]
    std::vector<std::uint8_t> silhouettes; ///< [points of the cloud], flagSilhouettes
};

/// Takes or finds the priors, and removes the quantisation of depths. Both need the cloud's range grids.
ScanPriors takePriors(Cloud& cloud, const Estimation& job) {
    ScanPriors priors;
    for (const Scan& scan : cloud.scans) priors.first_points.push_back(scan.first_point);
    priors.silhouettes = job.decided.silhouettes;
    if (!usesGrids(job.options) || cloud.grids.empty()) return priors;
    const Stopwatch watch(job.report.seconds_clean);
    job.report.dequantized = dequantizeDepths(cloud);
    priors.silhouettes = flagSilhouettes(cloud);
    return priors;
}

/// Sets scan_of_point, if there are several scans, and at_silhouette.
void applyPriors(PointSet& points, const ScanPriors& priors) {
    const std::vector<std::size_t>& first = priors.first_points;
    if (first.size() > 1) points.scan_of_point.resize(points.size());
    for (std::size_t i = 0; i < points.scan_of_point.size(); ++i) {
        const auto after = std::upper_bound(first.begin(), first.end(), points.input_index[i]);
        points.scan_of_point[i] = std::uint32_t(std::max<std::ptrdiff_t>(after - first.begin(), 1) - 1);
    }
    if (!priors.silhouettes.empty()) points.at_silhouette.resize(points.size());
    for (std::size_t i = 0; i < points.at_silhouette.size(); ++i)
        points.at_silhouette[i] = priors.silhouettes[points.input_index[i]];
}

/// Raises the planarity weight of noisy points around which cleaning has found a surface, however scattered they were:
/// to 1 at a support of kSure, which nine in ten points of the noisiest scans reach, falling to 0 at kNone.
void raisePlanarity(PointSet& points) {
    if (points.support.empty()) return;
    constexpr float kNone = 0.5f, kSure = 0.7f;
    for (std::size_t i = 0; i < points.planarity.size(); ++i)
        points.planarity[i] =
            std::max(points.planarity[i], std::clamp((points.support[i] - kNone) / (kSure - kNone), 0.0f, 1.0f));
}

void clean(PointGraph& graph, const ScanPriors& priors, const Estimation& job) {
    if (job.options.clean == 0) return;
    SurfaceReport& report = job.report;
    const Stopwatch watch(report.seconds_clean);
    applyPriors(graph.points, priors);
    CleanOptions options;
    options.keep_normals = job.options.normals == NormalSource::kKeep;
    options.strength = float(job.options.clean);
    options.scan_count = std::max<std::size_t>(priors.first_points.size(), 1);
    const std::vector<float>& decided_noise = job.decided.statistics.noise;
    if (decided_noise.size() == options.scan_count) options.noise_of_scans = decided_noise;
    CleanReport cleaned = cleanPoints(graph, options, job.progress);
    if (cleaned.moved > 0) surround(graph, job, {job.progress, "cleaning", 1, 1});
    raisePlanarity(graph.points);
    graph.points.scan_of_point = {}, graph.points.at_silhouette = {}; // no longer needed
    report.noise = std::move(cleaned.noise);
    report.clean_dropped = cleaned.dropped;
    for (const DequantizeReport::OfScan& each : report.dequantized.scans)
        if (each.scan < report.noise.size())
            report.noise[each.scan] = std::max(report.noise[each.scan], float(each.noise_over_spacing));
    report.clean_moved = std::max(cleaned.moved, report.dequantized.moved);
}

/// Makes points that look scattered, but that cleaning has moved onto a surface, count as points of the surface.
void trustSmoothed(PointGraph& graph, const Estimation& job) {
    const Stopwatch watch(job.report.seconds_clean);
    const StageProgress silent;
    raisePlanarityOfSmoothed(graph, {silent, kRadiusStage});
    graph.points.support = {}; // no longer needed
}

/// Samples the noise in one place of a larger cloud.
void samplePlaceNoise(PointGraph& graph, const ScanPriors& priors, const Estimation& job) {
    if (job.decided.inner.empty()) return;
    constexpr std::size_t kStep = 2; // places are small
    const std::size_t scans = std::max<std::size_t>(priors.first_points.size(), 1);
    applyPriors(graph.points, priors);
    job.report.noise_samples = {std::vector<std::vector<float>>(scans), std::vector<std::size_t>(scans)};
    sampleNoise(graph.points, graph.lists, innerOf(graph.points, job.decided), kStep, job.report.noise_samples);
    graph.points.scan_of_point = {}, graph.points.at_silhouette = {};
}

/// Sets planarity weights. Must be called before cleaning, after which scattered points would also lie on surfaces.
void setPlanarity(PointGraph& graph, const Estimation& job) {
    const Stopwatch watch(job.report.seconds_radii);
    const StageProgress silent;
    const PointSet& points = graph.points;
    const std::vector<std::uint8_t> inner = innerOf(points, job.decided);
    job.report.inner = std::size_t(std::count(inner.begin(), inner.end(), 1));
    job.report.scattered = weighPlanarity(graph, job.decided.statistics.scattered, inner, {silent, kRadiusStage});
}

/// Inserts points between scan lines. Their input indices count up from cloud_count. Returns for each of them the input
/// index of the point that it was copied from.
std::vector<std::uint32_t> fill(PointGraph& graph, std::size_t cloud_count, const Estimation& job) {
    std::vector<std::uint32_t> sources = fillBetweenLines(graph, job.decided.statistics.fill_rows, job.report.filling,
                                                          {job.progress, kRadiusStage, 0, kFillShare});
    if (!sources.empty()) surround(graph, job, {job.progress, kRadiusStage, kFillShare, kFillShare});
    std::vector<std::uint32_t>& input_index = graph.points.input_index;
    const std::size_t first = input_index.size() - sources.size();
    for (std::size_t i = 0; i < sources.size(); ++i) {
        sources[i] = input_index[sources[i]];
        input_index[first + i] = std::uint32_t(cloud_count + i);
    }
    return sources;
}

/// The reach beyond which points are sparse: more than that of 95% of the points, and so much more than that of the
/// densest that no point of an even sampling exceeds it.
float sparseReach(const PointGraph& graph, const Estimation& job) {
    constexpr float kFarBeyond =
        12; // raw range scans have at most 4, by overlap; as a power of two, half of it may be lost
    const float finest = *inPoints(graph.points, job.thinning.finest_cells);
    // A power of two, as in ThinnedCloud, so that it is mostly the same for samples of a set's places and of all
    // points.
    const float dense = finest > 0 ? std::ldexp(1.0f, std::ilogb(finest)) : 0;
    return std::max(std::ldexp(job.common_reach, -graph.points.scale_exponent), kFarBeyond * dense);
}

/// @param filled number of points inserted by fill
void setRadii(PointGraph& graph, std::size_t filled, bool oriented, const Estimation& job) {
    PointSet& points = graph.points;
    computeRadii(graph, oriented, {job.progress, kRadiusStage, kFillShare, 1});
    const auto decided_limit = inPoints(points, job.decided.statistics.radius_limit);
    shrinkPlates(graph, sparseReach(graph, job), decided_limit);
    shrinkSmoothed(points);
    limitRadii(points.radii, decided_limit);
    job.report.seen_through = clearSightlines(graph, points.size() - filled, {job.progress, kRadiusStage, 1, 1});
    for (std::size_t i = 0; i < points.given_radii.size(); ++i)
        if (points.given_radii[i] > 0) points.radii[i] = points.given_radii[i];
}

/// Turns flagged points into balls. @param balls [points], or empty
void turnIntoBalls(PointSet& points, const std::vector<std::uint8_t>& balls, const Estimation& job) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!balls[i]) continue;
        points.normals[i] = Vec3f::Zero();
        if (!points.noise.empty()) points.noise[i] = 0; // the noise is that of a surface
        ++job.report.balls;
    }
}

/// Turns all points into balls: they show the points as they are, so nothing is smoothed or filled.
void makeBalls(PointGraph& graph, const Estimation& job) {
    const Stopwatch watch(job.report.seconds_radii);
    setBallRadii(graph, {job.progress, kRadiusStage});
    graph.points.normals.resize(graph.points.size());
    turnIntoBalls(graph.points, std::vector<std::uint8_t>(graph.points.size(), 1), job);
}

/// Facts about a cloud that are known before its surface is estimated.
struct KnownCloud {
    const ScanPriors& priors;
    std::size_t cloud_count;
    bool given_sides, has_normals;
};

/// Whether points that are on no surface may become balls. Points with given normals are on a surface.
bool choosesBalls(const KnownCloud& known, const Estimation& job) {
    return job.options.splat == SplatShape::kAuto && !known.has_normals;
}

/// Whether all points may become balls: not if the cloud is a part of a larger one.
bool choosesAll(const KnownCloud& known, const Estimation& job) {
    return choosesBalls(known, job) && !job.decided.statistics.scattered;
}

/// Results of the estimation beside the points' own.
struct MadeSplats {
    bool oriented = true;                   ///< the sides of balls are always known
    std::vector<std::uint32_t> filled_from; ///< Splats::filled_from
};

/// Makes discs, and balls of points on no surface.
MadeSplats makeSurface(PointGraph& graph, const KnownCloud& known, const Estimation& job) {
    MadeSplats made;
    const bool oriented = setNormals(graph, known.given_sides, job);
    setPlanarity(graph, job);
    if (choosesAll(known, job) && isVolume(job.report.scattered, job.report.inner)) {
        makeBalls(graph, job);
        return made;
    }
    made.oriented = oriented;
    samplePlaceNoise(graph, known.priors, job);
    if (oriented) clean(graph, known.priors, job);
    const bool may_have_balls =
        choosesBalls(known, job) && mayHaveBalls(graph.points, job.decided.statistics.scattered);
    trustSmoothed(graph, job);
    const Stopwatch watch(job.report.seconds_radii);
    made.filled_from = fill(graph, known.cloud_count, job);
    setRadii(graph, made.filled_from.size(), oriented, job);
    if (!may_have_balls) return made;
    const std::vector<std::uint8_t> balls = flagBalls(graph.points);
    shrinkBalls(graph.points, balls);
    turnIntoBalls(graph.points, balls, job);
    return made;
}

MadeSplats makeSplats(PointGraph& graph, const KnownCloud& known, const Estimation& job) {
    if (job.options.splat != SplatShape::kBall && !(choosesAll(known, job) && isTooSparse(graph)))
        return makeSurface(graph, known, job);
    makeBalls(graph, job);
    return {};
}

/// Converts back to input units.
Splats toSplats(PointSet&& points, double radius_scale) {
    Splats splats;
    splats.positions = std::move(points.positions);
    splats.normals = std::move(points.normals);
    splats.radii = std::move(points.radii);
    splats.colors = std::move(points.colors);
    splats.input_index = std::move(points.input_index);
    splats.noise = std::move(points.noise);
    const double unit = std::ldexp(1.0, points.scale_exponent);
    for (Vec3f& position : splats.positions) position = (position.cast<double>() * unit).cast<float>();
    for (float& radius : splats.radii) {
        const double wide = double(radius) * radius_scale * unit;
        radius = float(std::clamp<double>(wide, std::numeric_limits<float>::min(), std::numeric_limits<float>::max()));
    }
    for (float& sigma : splats.noise) sigma = float(double(sigma) * unit);
    return splats;
}

void requireValid(const SurfaceOptions& options) {
    if (options.neighbors < 3 || options.neighbors > 255)
        throw Error{ExitCode::kBadUsage, "the number of neighbours must be 3 to 255"};
    if (!(options.radius_scale > 0) || !std::isfinite(options.radius_scale))
        throw Error{ExitCode::kBadUsage, "the radius scale must be above 0"};
}

} // namespace
} // namespace surface

Splats estimateSplats(Cloud&& cloud, const SurfaceOptions& options, SurfaceReport& report,
                      const StageProgress& progress, const SurfaceDecisions& decided) {
    using namespace surface;
    report = {};
    requireValid(options);
    Estimation job{options, decided, progress, report};
    const std::vector<std::uint32_t> far_outliers = requireSurface(cloud.positions);
    const ScanPriors priors = takePriors(cloud, job);
    const Vec3d origin = cloud.origin;
    const std::size_t cloud_count = cloud.positions.size();
    const bool has_normals = !cloud.normals.empty() && options.normals != NormalSource::kEstimate;
    const KnownCloud known{priors, cloud_count, cloud.normal_sides, has_normals};

    PointGraph graph;
    graph.points = takePoints(std::move(cloud), far_outliers);
    report.duplicates_removed = cloud_count - far_outliers.size() - graph.points.size();
    connect(graph, job);
    report.outliers_removed += far_outliers.size();
    MadeSplats made = makeSplats(graph, known, job);
    Splats splats = toSplats(std::move(graph.points), options.radius_scale);
    splats.origin = origin;
    splats.input_count = std::uint32_t(cloud_count);
    splats.filled_from = std::move(made.filled_from);
    splats.oriented = made.oriented;
    report.filled = splats.filled_from.size();
    return splats;
}

} // namespace pointrt
