// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/plane_fit.h"

#include <cmath>

#include <algorithm>
#include <limits>
#include <pcl/common/eigen.h>

namespace pointrt::surface {
namespace {

/// Sums equally weighted samples; sums of squares about the first point's place are exact enough in double.
struct MomentSum {
    double x = 0, y = 0, z = 0;
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

    void add(const Vec3d& mean) {
        x += mean.x(), y += mean.y(), z += mean.z();
        xx += mean.x() * mean.x(), xy += mean.x() * mean.y(), xz += mean.x() * mean.z();
        yy += mean.y() * mean.y(), yz += mean.y() * mean.z(), zz += mean.z() * mean.z();
    }

    void add(const std::array<float, 6>& covariance) {
        xx += double(covariance[0]), xy += double(covariance[1]), xz += double(covariance[2]);
        yy += double(covariance[3]), yz += double(covariance[4]), zz += double(covariance[5]);
    }

    Moments average(double count) const {
        const double mx = x / count, my = y / count, mz = z / count;
        return {Vec3d(mx, my, mz).cast<float>(),
                {float(xx / count - mx * mx), float(xy / count - mx * my), float(xz / count - mx * mz),
                 float(yy / count - my * my), float(yz / count - my * mz), float(zz / count - mz * mz)}};
    }
};

Eigen::Matrix3d covarianceOf(const Moments& moments) {
    const auto& [xx, xy, xz, yy, yz, zz] = moments.covariance;
    Eigen::Matrix3d matrix;
    matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return matrix;
}

} // namespace

PlaneFit fitPlane(const Moments& moments) {
    Eigen::Matrix3d vectors;
    Vec3d values;
    pcl::eigen33(covarianceOf(moments), vectors, values);
    PlaneFit fit;
    const Vec3f normal = vectors.col(0).cast<float>();
    if (normal.allFinite() && normal.squaredNorm() > 0.5f) fit.normal = normal.normalized();
    // A strip 30 times as long as wide tells less about its plane than about its line.
    constexpr double kLine = 1.0 / (30 * 30);
    const bool line = !(values[1] > kLine * values[2]);
    fit.misfit = line ? std::numeric_limits<float>::infinity() : float(std::max(0.0, values[0]) / values[1]);
    return fit;
}

Moments momentsOf(const Points& points, std::span<const std::uint32_t> neighbors, std::size_t point) {
    MomentSum sum; // the point itself is at zero
    const Vec3d center = points.positions[point].cast<double>();
    for (const std::uint32_t neighbor : neighbors) sum.add(points.positions[neighbor].cast<double>() - center);
    return sum.average(double(neighbors.size() + 1));
}

Moments spreadMoments(const std::vector<Moments>& moments, const Points& points, const NeighborLists& lists,
                      std::size_t point) {
    MomentSum sum;
    const Vec3f center = points.positions[point];
    const auto add = [&](std::size_t other) {
        sum.add((points.positions[other] - center + moments[other].mean).cast<double>());
        sum.add(moments[other].covariance);
    };
    add(point);
    for (const std::uint32_t neighbor : lists.of(point)) add(neighbor);
    return sum.average(double(lists.k + 1));
}

float heightOver(const Points& points, const NeighborLists& lists, std::size_t point) {
    float sum = 0;
    for (const std::uint32_t neighbor : lists.of(point)) {
        const float height = points.normals[point].dot(points.positions[neighbor] - points.positions[point]);
        sum += height * height;
    }
    return std::sqrt(sum / float(lists.k));
}

} // namespace pointrt::surface
