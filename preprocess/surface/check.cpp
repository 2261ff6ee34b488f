// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/check.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "pointrt/tool.hpp"
#include "preprocess/surface/bounds.h"

namespace pointrt::surface {
namespace {

[[noreturn]] void fail(const std::string& reason) { throw Error{ExitCode::kBadInput, reason}; }

/// The position farthest from one.
Vec3d farthestFrom(const std::vector<Vec3f>& positions, const Vec3d& from) {
    Vec3d farthest = from;
    double distance = -1;
    for (const Vec3f& position : positions) {
        const double here = (position.cast<double>() - from).squaredNorm();
        if (here > distance) distance = here, farthest = position.cast<double>();
    }
    return farthest;
}

bool allOnLine(const std::vector<Vec3f>& positions, const Vec3d& base, const Vec3d& direction, double tolerance) {
    for (const Vec3f& position : positions)
        if ((position.cast<double>() - base).cross(direction).squaredNorm() > tolerance * tolerance) return false;
    return true;
}

} // namespace

void requireSurface(const std::vector<Vec3f>& positions) {
    const std::string count = std::to_string(positions.size());
    if (positions.size() < 3) fail(count + " point(s): a surface needs at least 3");

    const Bounds bounds = boundsOf(positions);
    const double extent = bounds.longestEdge();
    if (extent == 0) fail("all " + count + " points are equal");

    // The end of the cloud farthest from any point and the point farthest from that end span the line, if any.
    const Vec3d base = farthestFrom(positions, positions.front().cast<double>());
    const Vec3d direction = (farthestFrom(positions, base) - base).normalized();
    // Rounding moves a coordinate by 2^-24 of itself at most; four such errors meet in the distance.
    const double rounding = std::ldexp(bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).maxCoeff(), -22);
    if (allOnLine(positions, base, direction, 1e-6 * extent + rounding))
        fail("all " + count + " points lie on one line");
}

} // namespace pointrt::surface
