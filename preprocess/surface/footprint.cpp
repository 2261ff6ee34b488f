// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace pointrt::upright {
namespace {

using Vec2d = Eigen::Vector2d;

/// Cells along the longer edge of a ground plan, and sampled splats in it: some fifteen per cell.
constexpr int kCells = 24;
constexpr std::size_t kPlanned = 8192;
/// Cosine of 32 degrees: includes roofs and noisy ground.
constexpr double kLevel = 0.85;
/// Share of a cell's lowest splats to ignore as outliers, and least splats per cell.
constexpr double kOutlierShare = 0.03;
constexpr std::size_t kFewest = 4;
/// Least cells for a meaningful share.
constexpr double kFewestCells = 12;
/// Depth of a cell's ground, in cell edges.
constexpr double kGroundDepth = 0.5;
/// Depth of a floor, over the total height.
constexpr double kFloorDepth = 0.03;
/// Depth of the contact with the ground, over the total height: allows for noise.
constexpr double kContact = 0.015;
/// Least distance of the centroid from the edge of the contact's hull, over the root of its area.
constexpr double kBalance = 0.1;

/// Orthonormal; w is up.
struct Axes {
    Vec3d u, v, w;
};

Axes axesOver(const Vec3d& up) {
    const Vec3d other = std::abs(up.y()) < 0.9 ? Vec3d::UnitY() : Vec3d::UnitX();
    const Vec3d u = up.cross(other).normalized();
    return {u, up.cross(u), up};
}

struct Placed {
    std::size_t cell = 0;
    double height = 0, area = 0;
    bool level = false;
};

struct Range {
    double low = 0, high = 0;
    double size() const { return high - low; }
};

Range rangeOf(std::vector<double> values, double left_out) {
    const double low = quantile(values, left_out);
    return {low, quantile(values, 1 - left_out)};
}

struct Plan {
    Range heights;
    double cell = 0;            ///< edge of a cell
    double wide = 0;            ///< longer edge of the plan
    std::vector<Placed> splats; ///< by cell, then by height
};

Plan groundPlan(const SurfaceSample& sample, const Axes& axes) {
    const std::size_t step = std::max<std::size_t>(1, sample.positions.size() / kPlanned);
    std::vector<double> x, y, h;
    for (std::size_t i = 0; i < sample.positions.size(); i += step) {
        const Vec3d& position = sample.positions[i];
        x.push_back(position.dot(axes.u));
        y.push_back(position.dot(axes.v));
        h.push_back(position.dot(axes.w));
    }
    const Range across = rangeOf(x, 0.005), along = rangeOf(y, 0.005);
    Plan plan;
    plan.heights = rangeOf(h, 0.002);
    plan.wide = std::max({across.size(), along.size(), std::numeric_limits<double>::min()});
    plan.cell = plan.wide / kCells;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double column = (x[i] - across.low) / plan.cell, row = (y[i] - along.low) / plan.cell;
        if (!(column >= 0 && column <= kCells && row >= 0 && row <= kCells)) continue;
        plan.splats.push_back({std::size_t(row) * (kCells + 1) + std::size_t(column), h[i], sample.areas[i * step],
                               std::abs(sample.normals[i * step].dot(axes.w)) > kLevel});
    }
    std::sort(plan.splats.begin(), plan.splats.end(), [](const Placed& a, const Placed& b) {
        return std::pair(a.cell, a.height) < std::pair(b.cell, b.height);
    });
    return plan;
}

struct Ground {
    double height = 0;
    double level = 0; ///< the share of its area that is level
};

/// The ground in a cell, from its splats.
Ground groundOf(const Placed* first, std::size_t count, double depth) {
    const double base = first[std::size_t(kOutlierShare * double(count))].height;
    double level = 0, whole = 0;
    for (std::size_t i = 0; i < count && first[i].height <= base + depth; ++i) {
        whole += first[i].area;
        if (first[i].level) level += first[i].area;
    }
    return {base, whole > 0 ? level / whole : 0};
}

double shelvesOf(const Plan& plan) {
    constexpr double kMargin = 0.12; // over the total height: noise, sloping ground, steps
    double all = 0, between = 0;
    for (const Placed& splat : plan.splats) {
        if (!splat.level) continue;
        const double share = (splat.height - plan.heights.low) / plan.heights.size();
        all += splat.area;
        if (share > kMargin && share < 1 - kMargin) between += splat.area;
    }
    return all > 0 ? between / all : 0;
}

double middleOf(const Plan& plan) {
    std::vector<double> heights;
    for (const Placed& splat : plan.splats) heights.push_back(splat.height);
    return (quantile(heights, 0.5) - plan.heights.low) / plan.heights.size();
}

double cross(const Vec2d& a, const Vec2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners of the convex hull, counter-clockwise, approximated by the farthest points in kDirections directions; its
/// area is within 1%.
std::vector<Vec2d> convexHull(const std::vector<Vec2d>& points) {
    constexpr int kDirections = 32;
    std::vector<Vec2d> hull;
    for (int d = 0; d < kDirections; ++d) {
        const double angle = 2 * std::numbers::pi * d / kDirections;
        const Vec2d direction(std::cos(angle), std::sin(angle));
        const Vec2d* farthest = &points.front();
        double most = direction.dot(*farthest);
        for (const Vec2d& point : points)
            if (const double reach = direction.dot(point); reach > most) most = reach, farthest = &point;
        hull.push_back(*farthest);
    }
    return hull;
}

double areaOf(const std::vector<Vec2d>& hull) {
    double twice = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) twice += cross(hull[i], hull[(i + 1) % hull.size()]);
    return twice / 2;
}

/// Distance of a point from the nearest side; negative outside.
double marginOf(const std::vector<Vec2d>& hull, const Vec2d& point) {
    double margin = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Vec2d side = hull[(i + 1) % hull.size()] - hull[i];
        if (side.norm() > 0) margin = std::min(margin, cross(side, point - hull[i]) / side.norm());
    }
    return margin;
}

} // namespace

Footprint footprintOf(const SurfaceSample& sample, const Vec3d& up) {
    const Plan plan = groundPlan(sample, axesOver(up));
    Footprint print;
    if (plan.splats.empty()) return print;
    double cells = 0;
    for (std::size_t begin = 0, end = 0; begin < plan.splats.size(); begin = end) {
        while (end < plan.splats.size() && plan.splats[end].cell == plan.splats[begin].cell) ++end;
        if (end - begin < kFewest) continue;
        const Ground ground = groundOf(&plan.splats[begin], end - begin, kGroundDepth * plan.cell);
        const double floor = plan.heights.low + kFloorDepth * std::max(plan.heights.size(), plan.cell);
        print.level += ground.level;
        if (ground.level > 0.6 && ground.height < floor) print.floor += 1; // mostly level
        cells += 1;
    }
    const double share = cells >= kFewestCells ? 1 / cells : 0;
    print.level *= share;
    print.floor *= share;
    print.height = plan.heights.size() / plan.wide;
    if (plan.heights.size() > 0) {
        print.shelves = shelvesOf(plan);
        print.middle = middleOf(plan);
    }
    return print;
}

double supportOf(const SurfaceSample& sample, const Vec3d& up) {
    const Axes axes = axesOver(up);
    std::vector<double> heights;
    for (const Vec3d& position : sample.positions) heights.push_back(position.dot(up));
    const Range range = rangeOf(heights, 0.001);
    std::vector<Vec2d> all, touching;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        all.emplace_back(sample.positions[i].dot(axes.u), sample.positions[i].dot(axes.v));
        if (heights[i] <= range.low + kContact * range.size()) touching.push_back(all.back());
    }
    if (touching.size() < 2 * kFewest) return 0;
    const std::vector<Vec2d> hull = convexHull(touching);
    const double area = areaOf(hull), whole = areaOf(convexHull(all));
    if (!(area > 0 && whole > 0)) return 0;
    const Vec2d centroid(sample.centroid.dot(axes.u), sample.centroid.dot(axes.v));
    return marginOf(hull, centroid) > kBalance * std::sqrt(area) ? area / whole : 0;
}

} // namespace pointrt::upright
