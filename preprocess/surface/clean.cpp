// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/clean.h"

#include <algorithm>

#include "preprocess/surface/project.h"

namespace pointrt::surface {
namespace {

constexpr const char* kCleaning = "cleaning";

/// Shares of the stage's time, as measured.
constexpr double kMeasured = 0.2, kProjected = 0.85;

std::uint32_t scanOf(const PointSet& points, std::size_t point) {
    return points.scan_of_point.empty() ? 0 : points.scan_of_point[point];
}

void dropSilhouettes(PointGraph& graph, CleanReport& report) {
    const PointSet& points = graph.points;
    std::vector<std::uint8_t> keep(points.size(), 1);
    for (std::size_t i = 0; i < points.at_silhouette.size(); ++i)
        keep[i] =
            !(points.at_silhouette[i] && report.noise[scanOf(points, i)] > kCleanNoise) || points.hasGivenRadius(i);
    const auto dropped = std::size_t(std::count(keep.begin(), keep.end(), 0));
    if (dropped == 0) return;
    report.dropped += dropped;
    graph.keep(keep);
}

/// localNoise, but 0 if the scan or the surroundings are clean, and limited to what is likely in this scan: in raw
/// range scans, 9 in 10 points are below 1.6 times the scan's noise. Larger deviations are shape.
std::vector<float> noiseToSmooth(const PointGraph& graph, const std::vector<float>& noise_of_scans,
                                 const StageShare& share) {
    const PointSet& points = graph.points;
    constexpr float kLikely = 2;
    std::vector<float> sigma = localNoise(points, graph.lists, share);
    for (std::size_t i = 0; i < sigma.size(); ++i) {
        const float of_scan = noise_of_scans[scanOf(points, i)], spacing = graph.lists.spacings[i];
        const bool noisy = of_scan > kCleanNoise && sigma[i] > kCleanNoise * spacing;
        sigma[i] = noisy ? std::min(sigma[i], kLikely * of_scan * spacing) : 0;
    }
    return sigma;
}

void dropOffSurface(PointGraph& graph, const std::vector<std::uint8_t>& off_surface, CleanReport& report) {
    std::vector<std::uint8_t> keep(off_surface.size());
    for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = !off_surface[i];
    report.dropped += std::size_t(std::count(keep.begin(), keep.end(), 0));
    keepRows(graph.points, keep);
}

} // namespace

CleanReport cleanPoints(PointGraph& graph, const CleanOptions& options, const StageProgress& progress) {
    PointSet& points = graph.points;
    CleanReport report;
    report.noise = options.noise_of_scans;
    if (report.noise.empty() && points.size() < kFewForNoise) return report;
    if (report.noise.empty()) report.noise = scanNoise(points, graph.lists, options.scan_count);
    if (std::all_of(report.noise.begin(), report.noise.end(), [](float noise) { return noise <= kCleanNoise; }))
        return report;
    dropSilhouettes(graph, report);
    points.noise = noiseToSmooth(graph, report.noise, {progress, kCleaning, 0, kMeasured});
    const std::vector<Vec3f> normals = options.keep_normals ? points.normals : std::vector<Vec3f>();
    const ProjectionReport projected =
        projectPoints(graph, options.strength, {progress, kCleaning, kMeasured, kProjected});
    report.moved = projected.moved;
    if (options.keep_normals) points.normals = normals;
    dropOffSurface(graph, projected.off_surface, report);
    graph.connect(graph.lists.k, {progress, kCleaning, kProjected, 1});
    return report;
}

} // namespace pointrt::surface
