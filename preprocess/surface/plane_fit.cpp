// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/plane_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <pcl/common/centroid.h>
#include <pcl/common/eigen.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pointrt::surface {
namespace {

/// Sums moments of equal weight. In double, sums of squares relative to the point are exact enough.
struct MomentSum {
    double x = 0, y = 0, z = 0;
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

    void add(const Vec3d& mean, const std::array<float, 6>& covariance) {
        x += mean.x(), y += mean.y(), z += mean.z();
        xx += mean.x() * mean.x(), xy += mean.x() * mean.y(), xz += mean.x() * mean.z();
        yy += mean.y() * mean.y(), yz += mean.y() * mean.z(), zz += mean.z() * mean.z();
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

/// The point and its neighbours. A cloud for each call: one that a thread kept would be destroyed on Windows after its
/// memory (GCC's emulated thread_local), and the allocation takes less than the sums.
pcl::PointCloud<pcl::PointXYZ> gather(const PointSet& points, std::span<const std::uint32_t> neighbors,
                                      std::size_t point) {
    pcl::PointCloud<pcl::PointXYZ> cloud(static_cast<std::uint32_t>(neighbors.size() + 1), 1);
    cloud[0].getVector3fMap() = points.positions[point]; // PCL sums relative to the first point
    for (std::size_t i = 0; i < neighbors.size(); ++i) cloud[i + 1].getVector3fMap() = points.positions[neighbors[i]];
    return cloud;
}

Eigen::Matrix3d covarianceOf(const Moments& moments) {
    const auto& [xx, xy, xz, yy, yz, zz] = moments.covariance;
    Eigen::Matrix3d matrix;
    matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return matrix;
}

/// @param values eigenvalues in increasing order
float misfitOf(const Vec3d& values) {
    // A strip 30 times as long as wide determines a line, not a plane.
    constexpr double kLine = 1.0 / (30 * 30);
    const bool line = !(values[1] > kLine * values[2]);
    return line ? std::numeric_limits<float>::infinity() : float(std::max(0.0, values[0]) / values[1]);
}

} // namespace

PlaneFit fitPlane(const Moments& moments) {
    Eigen::Matrix3d vectors;
    Vec3d values;
    pcl::eigen33(covarianceOf(moments), vectors, values);
    PlaneFit fit;
    const Vec3f normal = vectors.col(0).cast<float>();
    if (normal.allFinite() && normal.squaredNorm() > 0.5f) fit.normal = normal.normalized();
    fit.misfit = misfitOf(values);
    return fit;
}

float misfitOf(const Moments& moments) {
    Vec3d values;
    pcl::eigen33(covarianceOf(moments), values);
    return misfitOf(values);
}

Moments momentsOf(const PointSet& points, std::span<const std::uint32_t> neighbors, std::size_t point) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    Eigen::Vector4d mean = Eigen::Vector4d::Zero();
    pcl::computeMeanAndCovarianceMatrix(gather(points, neighbors, point), covariance, mean);
    const auto at = [&](int row, int column) { return float(covariance(row, column)); };
    return {(mean.head<3>() - points.positions[point].cast<double>()).cast<float>(),
            {at(0, 0), at(0, 1), at(0, 2), at(1, 1), at(1, 2), at(2, 2)}};
}

Moments spreadMoments(const std::vector<Moments>& moments, const PointSet& points, const NeighborLists& lists,
                      std::size_t point) {
    MomentSum sum;
    const Vec3f center = points.positions[point];
    const auto add = [&](std::size_t other) {
        sum.add((points.positions[other] - center + moments[other].mean).cast<double>(), moments[other].covariance);
    };
    add(point);
    for (const std::uint32_t neighbor : lists.of(point)) add(neighbor);
    return sum.average(double(lists.k + 1));
}

float heightOver(const PointSet& points, const NeighborLists& lists, std::size_t point) {
    float sum = 0;
    for (const std::uint32_t neighbor : lists.of(point)) {
        const float height = points.normals[point].dot(points.positions[neighbor] - points.positions[point]);
        sum += height * height;
    }
    return std::sqrt(sum / float(lists.k));
}

} // namespace pointrt::surface
