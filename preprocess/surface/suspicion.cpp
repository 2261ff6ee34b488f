// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/suspicion.h"

#include <cmath>

namespace pointrt::surface {
namespace {

/// Limit of isOnLine.
constexpr double kSureLine = 0.139;
/// A list below this may be on a line: trails of clumps are, but so are the border of a surface and 1 in 10 random
/// lists.
constexpr double kElongated = 0.2;

/// A list is clumpy if its last neighbour is at least this many times as far away as its sixth: the ratio is 1.6 on a
/// surface and 2.7 on a line. At 3, 1 in 250 random lists is clumpy.
constexpr float kClumpy = 4;

/// Whether (b + c) a / (a + b + c)^2 is below a limit; avoids an eigenvalue solver.
bool isElongated(const Moments& moments, double limit) {
    const auto& [xx, xy, xz, yy, yz, zz] = moments.covariance;
    const double trace = double(xx) + yy + zz;
    const double invariant =
        double(xx) * yy + double(xx) * zz + double(yy) * zz - double(xy) * xy - double(xz) * xz - double(yz) * yz;
    return invariant < limit * trace * trace;
}

} // namespace

Moments quickMoments(const NeighborLists& lists, const PointSet& points, std::size_t point) {
    const Vec3f from = points.positions[point];
    Vec3f sum = Vec3f::Zero();
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    for (const std::uint32_t other : lists.of(point)) {
        const Vec3f offset = points.positions[other] - from;
        sum += offset;
        xx += offset.x() * offset.x(), xy += offset.x() * offset.y(), xz += offset.x() * offset.z();
        yy += offset.y() * offset.y(), yz += offset.y() * offset.z(), zz += offset.z() * offset.z();
    }
    const auto count = float(lists.k + 1);
    const Vec3f mean = sum / count;
    const float mx = mean.x(), my = mean.y(), mz = mean.z();
    return {mean,
            {xx / count - mx * mx, xy / count - mx * my, xz / count - mx * mz, yy / count - my * my,
             yz / count - my * mz, zz / count - mz * mz}};
}

bool isOnLine(const Moments& moments) { return isElongated(moments, kSureLine); }

Suspicion suspicionOf(const NeighborLists& lists, const PointSet& points, std::size_t point) {
    const Moments moments = quickMoments(lists, points, point);
    if (lists.radius(points, point) > kClumpy * lists.distance(points, point, kClumpSize - 1))
        return Suspicion::kInClump;
    if (isOnLine(moments)) return Suspicion::kOnLine;
    return isElongated(moments, kElongated) ? Suspicion::kMaybeLine : Suspicion::kUnsuspected;
}

bool isInNoPlane(const NeighborLists& lists, const PointSet& points, std::size_t point, float misfit) {
    const float own = misfitOf(quickMoments(lists, points, point));
    return own > misfit && std::isfinite(own);
}

bool isOneSided(const NeighborLists& lists, const PointSet& points, std::size_t point) {
    constexpr float kOffCenter = 0.35f;
    return quickMoments(lists, points, point).mean.norm() > kOffCenter * lists.radius(points, point);
}

} // namespace pointrt::surface
