// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "format/base/error.h"
#include "preprocess/cloud/bounds.h"
#include "preprocess/cloud/median.h"

namespace pointrt::surface {
namespace {

[[noreturn]] void fail(const std::string& reason) { throw Error{ExitCode::kBadInput, reason}; }

/// The position farthest from the given one; the first one of equally distant positions.
Vec3d farthestFrom(const std::vector<Vec3f>& positions, const Vec3d& from) {
    struct Farthest {
        double distance = -1;
        std::size_t index = 0;
    };
    const auto search = [&](const auto& range, Farthest farthest) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const double here = (positions[i].cast<double>() - from).squaredNorm();
            if (here > farthest.distance) farthest = {here, i};
        }
        return farthest;
    };
    const auto farther = [](const Farthest& a, const Farthest& b) { return b.distance > a.distance ? b : a; };
    const tbb::blocked_range<std::size_t> all(0, positions.size());
    return positions[tbb::parallel_reduce(all, Farthest{}, search, farther).index].cast<double>();
}

bool allOnLine(const std::vector<Vec3f>& positions, const Vec3d& base, const Vec3d& direction, double tolerance) {
    for (const Vec3f& position : positions)
        if ((position.cast<double>() - base).cross(direction).squaredNorm() > tolerance * tolerance) return false;
    return true;
}

/// Whether all are on a line to within a millionth of their extent and the rounding of float.
bool onLine(const std::vector<Vec3f>& positions, const Bounds& bounds) {
    // If all points are on a line, the point farthest from any of them is one end, and the point farthest from that is
    // the other.
    const Vec3d base = farthestFrom(positions, positions.front().cast<double>());
    const Vec3d direction = (farthestFrom(positions, base) - base).normalized();
    // Rounding changes a coordinate by at most 2^-24 of itself; the distance has four such errors.
    const double rounding = std::ldexp(bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).maxCoeff(), -22);
    return allOnLine(positions, base, direction, 1e-6 * bounds.longestEdge() + rounding);
}

/// In a cloud scaled to an extent of 1, points that together span only 2^-60 of it are a hundredth of that apart, so
/// their squared distances are 2^-134: floats have few bits for these, and soon underflow.
const double kMostExtents = std::ldexp(1.0, 60);

/// Indices, ascending, of the points more than 100 times as far from the median as 99% of all points: such an outlier
/// makes all points seem to be on a line. Empty for fewer than 100 points.
std::vector<std::uint32_t> farOutliers(const std::vector<Vec3f>& positions) {
    constexpr double kShare = 0.99, kFar = 100;
    Vec3d middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<float> values;
        for (const Vec3f& position : positions) values.push_back(position[axis]);
        middle[axis] = double(medianOf(std::move(values)));
    }
    std::vector<double> distances;
    for (const Vec3f& position : positions) distances.push_back((position.cast<double>() - middle).norm());
    const double limit = kFar * quantileOf(distances, kShare);
    std::vector<std::uint32_t> far;
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (!(distances[i] <= limit)) far.push_back(std::uint32_t(i));
    return far;
}

std::vector<Vec3f> without(const std::vector<Vec3f>& positions, const std::vector<std::uint32_t>& left_out) {
    std::vector<Vec3f> kept;
    auto next = left_out.begin();
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (next != left_out.end() && *next == i)
            ++next;
        else
            kept.push_back(positions[i]);
    return kept;
}

} // namespace

std::vector<std::uint32_t> requireSurface(const std::vector<Vec3f>& positions) {
    const std::string count = std::to_string(positions.size());
    if (positions.size() < 3) fail(count + " point(s): a surface needs at least 3");
    const Bounds bounds = boundsOf(positions);
    if (bounds.longestEdge() == 0) fail("all " + count + " points are equal");
    if (!onLine(positions, bounds)) return {};
    const std::vector<std::uint32_t> far = farOutliers(positions);
    const std::vector<Vec3f> near = without(positions, far);
    const Bounds near_bounds = boundsOf(near);
    if (far.empty() || onLine(near, near_bounds)) fail("all " + count + " points lie on one line");
    return bounds.longestEdge() > kMostExtents * near_bounds.longestEdge() ? far : std::vector<std::uint32_t>();
}

} // namespace pointrt::surface
