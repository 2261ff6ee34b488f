// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/clean.h"

#include <algorithm>

#include "preprocess/cloud/keep_flagged.h"
#include "preprocess/surface/project.h"

namespace pointrt::surface {
namespace {

constexpr const char* kStage = "cleaning";

/// Shares of the stage's time, as measured.
constexpr double kMeasured = 0.2, kProjected = 0.85;

std::uint32_t scanOf(const CleanInput& input, std::size_t point) {
    return input.scan_of_point.empty() ? 0 : input.scan_of_point[point];
}

/// 1 for points to keep.
std::vector<std::uint8_t> withoutRims(const CleanInput& input, const std::vector<float>& noise, const Points& points) {
    std::vector<std::uint8_t> keep(points.size(), 1);
    for (std::size_t i = 0; i < input.rims.size(); ++i)
        keep[i] = !(input.rims[i] && noise[scanOf(input, i)] > kCleanNoise) || points.hasRadius(i);
    return keep;
}

void dropRims(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search, CleanInput& input,
              CleanReport& report) {
    const std::vector<std::uint8_t> keep = withoutRims(input, report.noise, points);
    const auto dropped = std::size_t(std::count(keep.begin(), keep.end(), 0));
    if (dropped == 0) return;
    report.dropped += dropped;
    keepPoints(points, keep);
    keepFlagged(input.scan_of_point, keep);
    search.emplace(points.positions);
    keepNeighbors(lists, keep, points, *search);
}

/// noiseOfPlaces, but 0 where the scan or the place is clean.
std::vector<float> noiseToSmooth(const Points& points, const NeighborLists& lists, const CleanInput& input,
                                 const std::vector<float>& noise, const StageShare& share) {
    std::vector<float> sigma = noiseOfPlaces(points, lists, share);
    for (std::size_t i = 0; i < sigma.size(); ++i) {
        const bool noisy = noise[scanOf(input, i)] > kCleanNoise && sigma[i] > kCleanNoise * lists.spacings[i];
        if (!noisy) sigma[i] = 0;
    }
    return sigma;
}

} // namespace

CleanReport cleanPoints(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search, CleanInput& input,
                        const StageProgress& progress) {
    CleanReport report;
    report.noise = input.noise_of_scans;
    if (report.noise.empty() && points.size() < kFewForNoise) return report;
    if (report.noise.empty()) report.noise = noiseOfScans(points, lists, input.scan_of_point, input.scan_count);
    if (std::all_of(report.noise.begin(), report.noise.end(), [](float noise) { return noise <= kCleanNoise; }))
        return report;
    dropRims(points, lists, search, input, report);
    const std::vector<float> sigma =
        noiseToSmooth(points, lists, input, report.noise, {progress, kStage, 0, kMeasured});
    const std::vector<Vec3f> normals = input.keep_normals ? points.normals : std::vector<Vec3f>();
    ProjectionReport projected =
        projectPoints(points, lists, *search, sigma, input.strength, {progress, kStage, kMeasured, kProjected});
    report.moved = projected.moved;
    report.sigma = std::move(projected.sigma);
    report.support = std::move(projected.support);

    if (input.keep_normals) points.normals = normals;
    std::vector<std::uint8_t> sound(points.size());
    for (std::size_t i = 0; i < sound.size(); ++i) sound[i] = !projected.lost[i];
    report.dropped += std::size_t(std::count(sound.begin(), sound.end(), 0));
    keepPoints(points, sound);
    keepFlagged(report.sigma, sound);
    keepFlagged(report.support, sound);
    search.emplace(points.positions);
    lists = findNeighbors(points, *search, lists.k, {progress, kStage, kProjected, 1});
    return report;
}

} // namespace pointrt::surface
