// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/scene/camera.h"

namespace pointrt {
namespace {

/// Cells along the edge of a picture: a few thousand splats leave about ten in each, five of them on the near side.
constexpr int kCells = 28;
/// Splats up to this far behind the nearest one of a cell, in cell edges, are on the same surface.
constexpr double kSurfaceDepth = 1.5;

/// Splats within about a degree of the plane through the eye are ignored.
constexpr double kMinAheadCosine = 0.02;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr std::size_t kOutside = kCells * kCells;

struct Placed {
    std::size_t cell = kOutside;
    double depth = 0;
};

std::size_t cellOf(double x, double y) {
    if (!(x >= 0 && x < kCells && y >= 0 && y < kCells)) return kOutside;
    return static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x);
}

std::vector<double> nearest(const std::vector<Placed>& placed) {
    std::vector<double> depths(kOutside, kFar);
    for (const Placed& splat : placed)
        if (splat.cell != kOutside) depths[splat.cell] = std::min(depths[splat.cell], splat.depth);
    return depths;
}

/// The centre and half extents of a disc in the picture, in cells.
struct Outline {
    double x, y, reach_x, reach_y;
};

/// Rasterizes a disc: lowers the depth of the cells whose centres lie in its ellipse, and of the cell at its centre.
void rasterize(std::vector<double>& depths, const Outline& disc, double depth) {
    const auto nearer = [&](std::size_t cell) {
        if (cell != kOutside) depths[cell] = std::min(depths[cell], depth);
    };
    nearer(cellOf(disc.x, disc.y));
    const auto first = [](double low) { return static_cast<int>(std::clamp(low, 0.0, double{kCells})); };
    for (int row = first(disc.y - disc.reach_y); row < kCells && row + 0.5 < disc.y + disc.reach_y; ++row)
        for (int column = first(disc.x - disc.reach_x); column < kCells && column + 0.5 < disc.x + disc.reach_x;
             ++column) {
            const double x = column + 0.5, y = row + 0.5;
            if (std::hypot((x - disc.x) / disc.reach_x, (y - disc.y) / disc.reach_y) < 1) nearer(cellOf(x, y));
        }
}

/// Cosine of the angle between a splat's front and the direction to the viewer. Balls have fronts on all sides.
double facing(const SampledSplat& splat, Vec3 forward) {
    return splat.normal == Vec3{} ? 1 : -dot(splat.normal, forward);
}

} // namespace

Visibility visibleAlong(const SceneSample& sample, const SampleBox& box, const ViewBasis& basis) {
    const Vec3 middle = 0.5 * (box.low + box.high);
    const double edge = length(box.high - box.low) / kCells;
    Visibility visible;
    if (!(edge > 0)) return visible;
    std::vector<Placed> placed;
    for (const SampledSplat& splat : sample.splats) {
        const Vec3 to = splat.position - middle;
        placed.push_back({cellOf(dot(to, basis.right) / edge + kCells / 2.0, dot(to, basis.up) / edge + kCells / 2.0),
                          dot(to, basis.forward) / edge});
    }
    const std::vector<double> depths = nearest(placed);
    std::vector<double> fronts(kOutside, 0);
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const auto [cell, depth] = placed[i];
        if (cell == kOutside || depth > depths[cell] + kSurfaceDepth) continue;
        visible.seen.push_back(static_cast<std::uint32_t>(i));
        fronts[cell] += facing(sample.splats[i], basis.forward);
    }
    for (std::size_t cell = 0; cell < kOutside; ++cell) {
        if (depths[cell] == kFar) continue;
        visible.covered += 1.0 / kOutside;
        if (fronts[cell] > 0 || !sample.oriented) visible.facing += 1.0 / kOutside;
    }
    return visible;
}

namespace {

/// A square picture: the cell and distance of each splat, and the distance of the nearest disc in each cell.
struct Panel {
    std::vector<Placed> placed;
    std::vector<double> depths;
};

Panel panelFrom(const SceneSample& sample, Vec3 eye, const ViewBasis& basis, double fov_deg) {
    const double half = std::tan(fov_deg * std::numbers::pi / 360);
    Panel panel{std::vector<Placed>(sample.splats.size()), std::vector<double>(kOutside, kFar)};
    auto& [placed, depths] = panel;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const SampledSplat& splat = sample.splats[i];
        const Vec3 to = splat.position - eye;
        const double ahead = dot(to, basis.forward);
        if (!(ahead > kMinAheadCosine * length(to))) continue;
        const double cells = kCells / (2 * ahead * half); // per unit of length
        const double x = dot(to, basis.right) * cells + kCells / 2.0, y = dot(to, basis.up) * cells + kCells / 2.0;
        placed[i] = {cellOf(x, y), length(to)};
        rasterize(depths, {x, y, cells * halfExtentAlong(splat, basis.right), cells * halfExtentAlong(splat, basis.up)},
                  length(to));
    }
    return panel;
}

bool isVisible(const Panel& panel, std::size_t splat) {
    const auto [cell, depth] = panel.placed[splat];
    return cell != kOutside && depth <= 1.25 * panel.depths[cell]; // a margin for oblique and noisy walls
}

double medianOf(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The share of the cells within 16 degrees of a level picture's middle that are covered.
double levelShare(const std::vector<double>& depths) {
    constexpr int kRows = kCells / 7; // on each side: the tangent is 2 / 7
    const auto first = depths.begin() + (kCells / 2 - kRows) * kCells, last = first + 2 * kRows * kCells;
    const auto empty = std::count(first, last, kFar);
    return 1 - static_cast<double>(empty) / static_cast<double>(last - first);
}

} // namespace

double visibleWeight(const SceneSample& sample, const std::vector<double>& weights, Vec3 eye, const ViewBasis& basis,
                     double fov_deg) {
    const Panel panel = panelFrom(sample, eye, basis, fov_deg);
    double seen = 0;
    for (std::size_t i = 0; i < panel.placed.size(); ++i)
        if (isVisible(panel, i)) seen += weights[i];
    return seen;
}

SceneSample visibleFrom(const SceneSample& sample, Vec3 eye, const ViewBasis& basis, double fov_deg) {
    const Panel panel = panelFrom(sample, eye, basis, fov_deg);
    SceneSample visible;
    for (std::size_t i = 0; i < panel.placed.size(); ++i)
        if (isVisible(panel, i)) visible.splats.push_back(sample.splats[i]);
    return visible;
}

Surrounding surroundingOf(const SceneSample& sample, Vec3 eye, Vec3 up) {
    const Vec3 front = frontSide(up), right = cross(up, front);
    Surrounding surrounding;
    std::vector<double> all;
    for (const Vec3 forward : {up, -1.0 * up, front, -1.0 * front, right, -1.0 * right}) {
        const bool steep = std::abs(dot(forward, up)) > 0.5;
        std::vector<double> depths = panelFrom(sample, eye, basisOf(forward, steep ? front : up), 90).depths;
        if (!steep) surrounding.level += levelShare(depths) / 4;
        std::erase(depths, kFar);
        const double covered = static_cast<double>(depths.size()) / kOutside;
        surrounding.covered += covered / 6;
        all.insert(all.end(), depths.begin(), depths.end());
        if (dot(forward, up) < 0.5) continue;
        surrounding.above = covered;
        // half of the directions in a square of 90 degrees are within tan^2 = 2 / pi of its axis; so the median
        // distance to a ceiling is sqrt(1 + 2 / pi) times its height
        surrounding.headroom = medianOf(depths) / std::sqrt(1 + 2 / std::numbers::pi);
    }
    surrounding.distance = medianOf(all);
    return surrounding;
}

bool isEnclosed(const Surrounding& surrounding) {
    // openings in a third of the ceiling or of all sides let enough of the lamps' light in; a window or a door does not
    return surrounding.above >= 2.0 / 3 && surrounding.covered >= 2.0 / 3;
}

} // namespace pointrt
