// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/surface_sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "preprocess/cloud/median.h"

namespace pointrt::upright {
namespace {

/// Enough for shares within 1%, with some hundred in contact with the ground.
constexpr std::size_t kSamples = 16384;

/// Cosine and sine of 10 degrees: tolerance for walls and floors of real rooms with noisy normals.
const double kAlong = std::cos(10 * std::numbers::pi / 180), kAcross = std::sin(10 * std::numbers::pi / 180);

/// Cosine of 5 degrees: directions nearer to an axis are snapped to it.
const double kAxisCosine = std::cos(5 * std::numbers::pi / 180);

/// Edge of the map of directions, a hemisphere: bins of some 5 degrees.
constexpr int kBins = 32;
constexpr double kLeastPlane = 0.05;
constexpr int kMostPlanes = 4;
/// Cosine of 20 degrees: nearer planes are the same.
const double kApart = std::cos(20 * std::numbers::pi / 180);

/// Limit of radii over the median, so that the large discs of sparse parts do not outweigh the others.
constexpr float kWidestRadius = 2;

/// The bin of a direction and its opposite, in the octahedral map of the upper hemisphere.
std::size_t binOf(const Vec3d& normal) {
    const Vec3d n = normal.z() < 0 ? Vec3d(-normal) : normal;
    const double sum = n.cwiseAbs().sum();
    // rotates the diamond |x| + |y| <= 1 into a square
    const auto cell = [&](double t) { return std::clamp(int((t + 1) / 2 * kBins), 0, kBins - 1); };
    return std::size_t(cell((n.x() + n.y()) / sum)) * kBins + std::size_t(cell((n.x() - n.y()) / sum));
}

/// The mean of the normals near a direction, and their share of the area.
std::pair<Vec3d, double> refined(const SurfaceSample& sample, Vec3d direction) {
    double share = 0;
    for (int round = 0; round < 3; ++round) {
        Vec3d sum = Vec3d::Zero();
        share = 0;
        for (std::size_t i = 0; i < sample.normals.size(); ++i) {
            const double along = sample.normals[i].dot(direction);
            if (std::abs(along) < kAlong) continue;
            sum += (along < 0 ? -sample.areas[i] : sample.areas[i]) * sample.normals[i];
            share += sample.areas[i];
        }
        if (sum.isZero()) return {direction, 0};
        direction = sum.normalized();
    }
    return {direction, share};
}

struct Bin {
    double area = 0;
    Vec3d sum = Vec3d::Zero();
};

std::vector<Bin> directionMap(const SurfaceSample& sample) {
    std::vector<Bin> bins(std::size_t{kBins} * kBins);
    for (std::size_t i = 0; i < sample.normals.size(); ++i) {
        if (sample.normals[i].isZero(0)) continue;
        Bin& bin = bins[binOf(sample.normals[i])];
        bin.area += sample.areas[i];
        bin.sum += (sample.normals[i].dot(bin.sum) < 0 ? -sample.areas[i] : sample.areas[i]) * sample.normals[i];
    }
    return bins;
}

float medianRadius(const Splats& splats, std::size_t step) {
    std::vector<float> radii;
    for (std::size_t i = 0; i < splats.radii.size(); i += step) radii.push_back(splats.radii[i]);
    return medianInPlace(radii);
}

/// The extent along an axis without 0.5% of the positions at each end.
double robustExtent(const SurfaceSample& sample, int axis) {
    std::vector<double> values;
    for (const Vec3d& position : sample.positions) values.push_back(position[axis]);
    const double low = quantile(values, 0.005);
    return quantile(values, 0.995) - low;
}

} // namespace

double quantile(std::vector<double>& values, double share) {
    const auto place = std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[std::size_t(place)];
}

SurfaceSample sampleSurface(const Splats& splats) {
    SurfaceSample sample;
    const std::size_t count = splats.positions.size(), step = std::max<std::size_t>(1, count / kSamples);
    if (count == 0) return sample;
    const float widest = kWidestRadius * medianRadius(splats, step);
    double whole = 0;
    for (std::size_t i = 0; i < count; i += step) {
        const double radius = std::min(splats.radii[i], widest);
        sample.positions.push_back(splats.positions[i].cast<double>());
        sample.normals.push_back(splats.normals[i].cast<double>());
        sample.areas.push_back(radius * radius);
        whole += sample.areas.back();
    }
    for (double& area : sample.areas) area = whole > 0 ? area / whole : 1 / double(sample.areas.size());
    for (std::size_t i = 0; i < sample.areas.size(); ++i) sample.centroid += sample.areas[i] * sample.positions[i];
    for (int axis = 0; axis < 3; ++axis) sample.extent[axis] = robustExtent(sample, axis);
    return sample;
}

double shareAlong(const SurfaceSample& sample, const Vec3d& direction) {
    double share = 0;
    for (std::size_t i = 0; i < sample.normals.size(); ++i)
        if (std::abs(sample.normals[i].dot(direction)) > kAlong) share += sample.areas[i];
    return share;
}

double shareAcross(const SurfaceSample& sample, const Vec3d& direction) {
    double share = 0;
    for (std::size_t i = 0; i < sample.normals.size(); ++i)
        if (std::abs(sample.normals[i].dot(direction)) < kAcross && !sample.normals[i].isZero(0))
            share += sample.areas[i];
    return share;
}

std::vector<Vec3d> slantedPlanes(const SurfaceSample& sample) {
    std::vector<Bin> bins = directionMap(sample);
    std::sort(bins.begin(), bins.end(), [](const Bin& a, const Bin& b) { return a.area > b.area; });
    std::vector<Vec3d> planes;
    for (std::size_t b = 0; b < 4 * kMostPlanes && planes.size() < kMostPlanes; ++b) { // a plane may have several bins
        if (!(bins[b].area > 0) || bins[b].sum.isZero()) break;
        const auto [normal, share] = refined(sample, bins[b].sum.normalized());
        const auto is_near = [&](const Vec3d& other, double cosine) { return std::abs(normal.dot(other)) > cosine; };
        const bool known =
            std::any_of(planes.begin(), planes.end(), [&](const Vec3d& p) { return is_near(p, kApart); });
        if (share < kLeastPlane || known || normal.cwiseAbs().maxCoeff() > kAxisCosine) continue;
        planes.push_back(normal);
    }
    return planes;
}

} // namespace pointrt::upright
