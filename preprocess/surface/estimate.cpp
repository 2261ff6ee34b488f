// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "format/base/error.h"
#include "preprocess/surface/check.h"
#include "preprocess/surface/clean.h"
#include "preprocess/surface/dimension.h"
#include "preprocess/surface/fill.h"
#include "preprocess/surface/lines.h"
#include "preprocess/surface/neighbors.h"
#include "preprocess/surface/normals.h"
#include "preprocess/surface/orient.h"
#include "preprocess/surface/outliers.h"
#include "preprocess/surface/points.h"
#include "preprocess/surface/radii.h"
#include "preprocess/surface/rims.h"
#include "preprocess/surface/sight.h"
#include "preprocess/surface/stages.h"

namespace pointrt {
namespace surface {
namespace {

constexpr const char* kNeighborStage = "neighbors";

/// A length in input units in the unit of the points.
std::optional<float> inPoints(const Points& points, const std::optional<float>& length) {
    if (!length) return std::nullopt;
    return std::ldexp(*length, -points.scale_exponent);
}

/// Drops strays from the points and all that was made from them.
void removeOutliers(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search,
                    const CloudTraits& decided, SurfaceReport& report) {
    const std::vector<std::uint8_t> keep = flagKept(points, lists, inPoints(points, decided.common_reach));
    report.outliers_removed = std::size_t(std::count(keep.begin(), keep.end(), 0));
    if (report.outliers_removed == 0) return;
    keepPoints(points, keep);
    const bool renumbered = refit(points);
    const StageProgress silent;
    search.emplace(points.positions);
    if (renumbered)
        lists = findNeighbors(points, *search, lists.k, {silent, kNeighborStage});
    else
        keepNeighbors(lists, keep, points, *search);
}

/// Finds the neighbours of all points but strays.
NeighborLists connect(Points& points, std::optional<NearestSearch>& search, const CloudTraits& decided,
                      const SurfaceOptions& options, SurfaceReport& report, const StageProgress& progress) {
    const Stopwatch watch(report.seconds_neighbors);
    search.emplace(points.positions);
    constexpr double kSearch = 0.9; // of the stage's time
    NeighborLists lists =
        findNeighbors(points, *search, std::size_t(options.neighbors), {progress, kNeighborStage, 0, kSearch});
    if (options.remove_outliers) removeOutliers(points, lists, search, decided, report);
    spreadLines(lists, points, *search, {progress, kNeighborStage, kSearch, 1});
    return lists;
}

/// Turns normals to the sides that are told, and flags them as given. Those seen at a grazing angle tell nothing: a
/// side stands for a wide surrounding, whose normal may be that far off.
void faceSides(Points& points, const std::vector<Vec3f>& sides, std::vector<std::uint8_t>& given) {
    constexpr float kGrazing = 0.3f; // cosine of 73 degrees
    for (std::size_t i = 0; i < points.size() && !sides.empty(); ++i) {
        const float cosine = points.normals[i].dot(sides[points.input_index[i]]);
        if (std::abs(cosine) < kGrazing || given[i]) continue;
        if (cosine < 0) points.normals[i] = -points.normals[i];
        given[i] = 1;
    }
}

/// Gives points their normals, on the right side; returns whether the side is known.
bool shape(Points& points, const NeighborLists& lists, const NearestSearch& search, bool normal_sides,
           const SurfaceDecisions& decided, const SurfaceOptions& options, SurfaceReport& report,
           const StageProgress& progress) {
    std::vector<std::uint8_t> given;
    {
        const Stopwatch watch(report.seconds_normals);
        given = fillNormals(points, lists, options.normals, progress);
        report.normals_estimated = std::size_t(std::count(given.begin(), given.end(), 0));
    }
    if (!normal_sides) std::fill(given.begin(), given.end(), std::uint8_t{0});
    faceSides(points, decided.sides, given);
    const Stopwatch watch(report.seconds_orient);
    return orientNormals(points, lists, search, given, options.orient, report.normals_flipped, progress);
}

/// What scans say of their points, by the points' indices in the cloud.
struct Known {
    std::vector<std::size_t> first_points; ///< [scans]
    std::vector<std::uint8_t> rims;        ///< flagRims
    std::vector<float> noise_of_scans;     ///< CloudTraits::noise, where it is decided
};

/// Levels what is stepped and takes down what only the cloud knows.
Known learn(Cloud& cloud, const SurfaceDecisions& decided, const SurfaceOptions& options, SurfaceReport& report) {
    Known known;
    for (const Scan& scan : cloud.scans) known.first_points.push_back(scan.first_point);
    known.noise_of_scans = decided.traits.noise;
    if (options.clean == 0 || cloud.grids.empty()) return known;
    const Stopwatch watch(report.seconds_clean);
    report.steps = levelSteps(cloud);
    known.rims = flagRims(cloud);
    return known;
}

/// The scan of each point by the first points of all scans; empty where there is one.
std::vector<std::uint32_t> scansOf(const Points& points, const std::vector<std::size_t>& first_points) {
    if (first_points.size() < 2) return {};
    std::vector<std::uint32_t> scans(points.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const auto after = std::upper_bound(first_points.begin(), first_points.end(), points.input_index[i]);
        scans[i] = std::uint32_t(std::max<std::ptrdiff_t>(after - first_points.begin(), 1) - 1);
    }
    return scans;
}

CleanReport clean(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search, const Known& known,
                  const SurfaceOptions& options, SurfaceReport& report, const StageProgress& progress) {
    if (options.clean == 0) return {};
    const Stopwatch watch(report.seconds_clean);
    CleanInput input;
    for (std::size_t i = 0; i < points.size() && !known.rims.empty(); ++i)
        input.rims.push_back(known.rims[points.input_index[i]]);
    input.keep_normals = options.normals == NormalSource::kKeep;
    input.strength = float(options.clean);
    input.scan_of_point = scansOf(points, known.first_points);
    input.scan_count = std::max<std::size_t>(known.first_points.size(), 1);
    if (known.noise_of_scans.size() == input.scan_count) input.noise_of_scans = known.noise_of_scans;
    CleanReport cleaned = cleanPoints(points, lists, search, input, progress);
    if (cleaned.moved > 0) spreadLines(lists, points, *search, {progress, "cleaning", 1, 1});
    report.noise = cleaned.noise;
    report.clean_dropped = cleaned.dropped;
    for (const LevelReport::OfScan& each : report.steps.scans)
        if (each.scan < report.noise.size())
            report.noise[each.scan] = std::max(report.noise[each.scan], float(each.noise_over_spacing));
    report.clean_moved = std::max(cleaned.moved, report.steps.moved);
    return cleaned;
}

/// Where a surface was found among noisy points there is one, however scattered they were: all of what supports it from
/// 70% on, which nine in ten places of the noisiest scans have, none of half.
void raiseShares(std::vector<float>& sheets, const std::vector<float>& support) {
    if (support.empty()) return;
    constexpr float kNone = 0.5f, kSure = 0.7f;
    for (std::size_t i = 0; i < sheets.size(); ++i)
        sheets[i] = std::max(sheets[i], std::clamp((support[i] - kNone) / (kSure - kNone), 0.0f, 1.0f));
}

/// What is scattered and what is not, before cleaning, which puts surfaces through scattered points.
std::vector<float> shares(const Points& points, const NeighborLists& lists, const SurfaceDecisions& decided,
                          SurfaceReport& report) {
    const Stopwatch watch(report.seconds_radii);
    const StageProgress silent;
    std::vector<std::uint8_t> inner(points.size(), 1);
    for (std::size_t i = 0; i < inner.size() && !decided.inner.empty(); ++i)
        inner[i] = decided.inner[points.input_index[i]];
    report.inner = std::size_t(std::count(inner.begin(), inner.end(), 1));
    return sheetShares(points, lists, decided.traits.scattered, inner, report.scattered, {silent, "radii"});
}

/// The shares of the points that are left, which may have been numbered anew; before, after: their indices in the
/// cloud.
std::vector<float> sharesLeft(const std::vector<float>& sheets, const std::vector<std::uint32_t>& before,
                              const std::vector<std::uint32_t>& after, std::size_t cloud_count) {
    if (sheets.empty()) return {};
    std::vector<float> of_cloud(cloud_count, 1), left(after.size());
    for (std::size_t i = 0; i < before.size(); ++i) of_cloud[before[i]] = sheets[i];
    for (std::size_t i = 0; i < after.size(); ++i) left[i] = of_cloud[after[i]];
    return left;
}

/// Puts points between scan lines, numbered from count up, as noisy as those beside them. Returns whose attributes each
/// carries, an index in the cloud.
std::vector<std::uint32_t> fill(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search,
                                std::vector<float>& sheets, std::vector<float>& noise, std::size_t count,
                                const CloudTraits& decided, SurfaceReport& report, const StageShare& share) {
    std::vector<std::uint32_t> carried =
        fillBetweenLines(points, lists, search, sheets, decided.fill_rows, report.filling, share);
    const std::size_t first = points.size() - carried.size();
    for (std::size_t i = 0; i < carried.size(); ++i) {
        if (!noise.empty()) noise.push_back(noise[carried[i]]);
        if (!sheets.empty()) sheets.push_back(sheets[carried[i]]);
        carried[i] = points.input_index[carried[i]];
        points.input_index[first + i] = std::uint32_t(count + i);
    }
    return carried;
}

/// Back to the cloud's unit.
Splats toSplats(Points&& points, std::vector<float>&& radii, double radius_scale) {
    Splats splats;
    splats.positions = std::move(points.positions);
    splats.normals = std::move(points.normals);
    splats.radii = std::move(radii);
    splats.colors = std::move(points.colors);
    splats.input_index = std::move(points.input_index);
    const double unit = std::ldexp(1.0, points.scale_exponent);
    for (Vec3f& position : splats.positions) position = (position.cast<double>() * unit).cast<float>();
    for (float& radius : splats.radii) {
        const double wide = double(radius) * radius_scale * unit;
        radius = float(std::clamp<double>(wide, std::numeric_limits<float>::min(), std::numeric_limits<float>::max()));
    }
    return splats;
}

template <typename Item>
void leaveOut(std::vector<Item>& items, const std::vector<std::uint32_t>& indices) {
    if (items.empty()) return;
    auto next = indices.begin();
    std::size_t kept = indices.front();
    for (std::size_t i = kept; i < items.size(); ++i)
        if (next != indices.end() && *next == i)
            ++next;
        else
            items[kept++] = items[i];
    items.resize(kept);
}

/// The cloud's points without those of the indices, ascending; their own indices stay those of the cloud.
Points takePointsBut(Cloud&& cloud, const std::vector<std::uint32_t>& left_out) {
    if (left_out.empty()) return takePoints(std::move(cloud));
    std::vector<std::uint32_t> cloud_index(cloud.positions.size());
    std::iota(cloud_index.begin(), cloud_index.end(), 0u);
    leaveOut(cloud_index, left_out);
    leaveOut(cloud.positions, left_out);
    leaveOut(cloud.normals, left_out);
    leaveOut(cloud.colors, left_out);
    leaveOut(cloud.sensor_of_point, left_out);
    leaveOut(cloud.radii, left_out);
    leaveOut(cloud.noise, left_out);
    Points points = takePoints(std::move(cloud));
    for (std::uint32_t& index : points.input_index) index = cloud_index[index];
    return points;
}

/// What says how large its discs are knows better than their neighbours.
void keepGivenRadii(const Points& points, std::vector<float>& radii) {
    for (std::size_t i = 0; i < points.radii.size(); ++i)
        if (points.radii[i] > 0) radii[i] = points.radii[i];
}

void requireSane(const SurfaceOptions& options) {
    if (options.neighbors < 3 || options.neighbors > 255)
        throw Error{ExitCode::kBadUsage, "the number of neighbors must be 3 to 255"};
    if (!(options.radius_scale > 0) || !std::isfinite(options.radius_scale))
        throw Error{ExitCode::kBadUsage, "the radius scale must be above 0"};
}

} // namespace
} // namespace surface

Splats estimateSplats(Cloud&& cloud, const SurfaceOptions& options, SurfaceReport& report,
                      const StageProgress& progress, const SurfaceDecisions& decided) {
    using namespace surface;
    report = {};
    requireSane(options);
    const std::vector<std::uint32_t> strays = requireSurface(cloud.positions);
    const Vec3d origin = cloud.origin;
    const bool normal_sides = cloud.normal_sides;
    const Known known = learn(cloud, decided, options, report);
    const std::size_t cloud_count = cloud.positions.size(), input_count = cloud_count - strays.size();

    Points points = takePointsBut(std::move(cloud), strays);
    report.duplicates_removed = input_count - points.size();
    std::optional<NearestSearch> search;
    NeighborLists lists = connect(points, search, decided.traits, options, report, progress);
    report.outliers_removed += strays.size();
    const bool oriented = shape(points, lists, *search, normal_sides, decided, options, report, progress);
    std::vector<float> sheets = shares(points, lists, decided, report);
    const std::vector<std::uint32_t> before = sheets.empty() ? std::vector<std::uint32_t>() : points.input_index;
    CleanReport cleaned;
    if (oriented) cleaned = clean(points, lists, search, known, options, report, progress);
    std::vector<float> noise = std::move(cleaned.sigma); // in the unit of the points; empty where all is clean
    sheets = sharesLeft(sheets, before, points.input_index, cloud_count);
    raiseShares(sheets, cleaned.support);
    std::vector<float> radii;
    std::vector<std::uint32_t> filled_from;
    {
        const Stopwatch watch(report.seconds_radii);
        constexpr double kFill = 0.2; // of the stage's time
        filled_from = fill(points, lists, search, sheets, noise, cloud_count, decided.traits, report,
                           {progress, "radii", 0, kFill});
        radii = discRadii(points, lists, *search, sheets, oriented, {progress, "radii", kFill, 1});
        shrinkPlates(radii, points, lists);
        tightenSmoothed(radii, noise);
        limitRadii(radii, inPoints(points, decided.traits.radius_limit));
        report.seen_through = endAtSights(points, points.size() - filled_from.size(), lists, noise, sheets, radii,
                                          {progress, "radii", 1, 1});
        keepGivenRadii(points, radii);
    }
    const double unit = std::ldexp(1.0, points.scale_exponent);
    Splats splats = toSplats(std::move(points), std::move(radii), options.radius_scale);
    splats.origin = origin;
    splats.input_count = std::uint32_t(cloud_count);
    splats.filled_from = std::move(filled_from);
    report.filled = splats.filled_from.size();
    splats.oriented = oriented;
    splats.noise = std::move(noise);
    for (float& sigma : splats.noise) sigma = float(double(sigma) * unit);
    return splats;
}

} // namespace pointrt
