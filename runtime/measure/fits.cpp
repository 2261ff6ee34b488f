// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pointrt/measure.hpp"
#include "runtime/measure/fit_round.h"
#include "runtime/measure/given_points.h"
#include "runtime/measure/principal_axes.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

/// Spreads below this share of the largest one are rounding errors: doubles resolve coordinates of seven digits to
/// 1e-9.
constexpr double kNoSpread = 1e-7;

Vec3 signedBy(Vec3 normal) {
    const Vec3 size = absolute(normal);
    const double largest = size.x >= size.y && size.x >= size.z ? normal.x : size.y >= size.z ? normal.y : normal.z;
    return largest < 0 ? -1.0 * normal : normal;
}

/// Throws TraceError kBadUsage if the points lie on a line.
PrincipalAxes axesOfPlane(std::span<const Vec3> points, const std::string& what) {
    const PrincipalAxes axes = principalAxes(points);
    if (!(axes.deviation[1] > kNoSpread * axes.deviation[0]))
        refuseMeasure("cannot fit " + what + ": the points lie on a line");
    return axes;
}

template <typename Distance>
double rmsOf(std::span<const Vec3> points, const Distance& distance) {
    double sum = 0;
    for (const Vec3& point : points) sum += std::pow(distance(point), 2);
    return std::sqrt(sum / static_cast<double>(points.size()));
}

} // namespace

FittedPlane fitPlane(std::span<const Position> given) {
    const std::vector<Vec3> points = vectorsOf(given, 3, "a plane");
    const PrincipalAxes axes = axesOfPlane(points, "a plane");
    return {arrayOf(axes.center), arrayOf(signedBy(axes.axes[2])), axes.deviation[2]};
}

FittedCircle fitCircle(std::span<const Position> given) {
    const std::vector<Vec3> points = vectorsOf(given, 3, "a circle");
    const PrincipalAxes axes = axesOfPlane(points, "a circle");
    const double unit = axes.deviation[0];
    std::vector<Row<2>> flat;
    for (const Vec3& point : points) {
        const Vec3 from_center = (1 / unit) * (point - axes.center);
        flat.push_back({dot(from_center, axes.axes[0]), dot(from_center, axes.axes[1])});
    }
    const auto round = fitRound<2>(flat);
    if (!round) refuseMeasure("cannot fit a circle: the points lie on a line");
    const Vec3 center = axes.center + unit * (round->center[0] * axes.axes[0] + round->center[1] * axes.axes[1]);
    const double radius = unit * round->radius;
    const double rms = rmsOf(points, [&](Vec3 point) {
        const double off_plane = dot(point - center, axes.axes[2]);
        return std::hypot(off_plane, length(point - center - off_plane * axes.axes[2]) - radius);
    });
    return {arrayOf(center), arrayOf(signedBy(axes.axes[2])), radius, rms};
}

FittedSphere fitSphere(std::span<const Position> given) {
    const std::vector<Vec3> points = vectorsOf(given, 4, "a sphere");
    const PrincipalAxes axes = principalAxes(points);
    const double unit = axes.deviation[0];
    std::vector<Row<3>> around;
    for (const Vec3& point : points) around.push_back(arrayOf((1 / unit) * (point - axes.center)));
    const bool is_flat = !(axes.deviation[2] > kNoSpread * unit);
    const auto round = is_flat ? std::nullopt : fitRound<3>(around);
    if (!round) refuseMeasure("cannot fit a sphere: the points lie in a plane");
    const Vec3 center = axes.center + unit * vectorOf(round->center);
    const double radius = unit * round->radius;
    return {arrayOf(center), radius, rmsOf(points, [&](Vec3 point) { return length(point - center) - radius; })};
}

} // namespace pointrt
