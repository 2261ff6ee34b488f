// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/gaussian_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pointrt {
namespace {

/// Twice what the search for up samples.
constexpr std::size_t kDiscs = 32768;

/// Fainter Gaussians are air: floaters, haze, and halos around objects.
constexpr float kLeastOpaque = 0.3f;

/// The shortest axis is a normal if it is at most this share of the next one.
constexpr float kFlat = 0.5f;

/// Share of the centres beyond each side of the box that measures the scene, and the largest deviation relative to the
/// longest edge of that box: skies and backgrounds are larger.
constexpr double kOutside = 0.01, kSky = 0.25;

/// A Gaussian that may belong to a surface.
struct OpaqueGaussian {
    std::size_t index = 0;
    double area_end = 0; ///< area of it and of those before it
};

std::array<int, 3> axesByLength(const float* deviations) {
    std::array<int, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return deviations[a] < deviations[b]; });
    return order;
}

double longestEdge(const Cloud& cloud, const GaussianColumns& gaussians) {
    double longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<float> values;
        for (std::size_t i = 0; i < cloud.positions.size(); ++i)
            if (gaussians.opacity[i] >= kLeastOpaque) values.push_back(cloud.positions[i][axis]);
        if (values.empty()) return 0;
        std::sort(values.begin(), values.end());
        const auto outside = static_cast<std::size_t>(kOutside * static_cast<double>(values.size()));
        longest = std::max(longest, double{values[values.size() - 1 - outside]} - double{values[outside]});
    }
    return longest;
}

std::vector<OpaqueGaussian> opaqueGaussians(const Cloud& cloud, const GaussianColumns& gaussians) {
    const double sky = kSky * longestEdge(cloud, gaussians);
    std::vector<OpaqueGaussian> opaque;
    double area = 0;
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const float* const deviations = gaussians.deviation + 3 * i;
        const auto [flat, middle, longest] = axesByLength(deviations);
        if (!(gaussians.opacity[i] >= kLeastOpaque) || deviations[longest] > sky) continue;
        area += double{gaussians.opacity[i]} * deviations[middle] * deviations[longest];
        opaque.push_back({i, area});
    }
    return opaque;
}

/// Fractions of number times irrational steps: even over the unit square (Roberts' R2 sequence).
Eigen::Vector2d evenlySpread(std::size_t number) {
    constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
    const Eigen::Vector2d at = double(number) * Eigen::Vector2d(kFirst, kSecond);
    return at - at.array().floor().matrix();
}

/// Adds a disc within the ellipse of one standard deviation of Gaussian i. number: of the disc, spreads them evenly.
/// Its normal is the shortest axis, or 0 if the Gaussian is not flat.
void addDisc(const Cloud& cloud, const GaussianColumns& gaussians, std::size_t i, std::size_t number, Splats& splats) {
    const float* const deviations = gaussians.deviation + 3 * i;
    const float* const turn = gaussians.rotation + 4 * i;
    const Eigen::Matrix3f axes = Eigen::Quaternionf(turn[0], turn[1], turn[2], turn[3]).toRotationMatrix();
    const auto [flat, middle, longest] = axesByLength(deviations);
    const Eigen::Vector2d spread = evenlySpread(number);
    const double radius = std::sqrt(spread.x()), angle = 2 * std::numbers::pi * spread.y();
    const auto across = static_cast<float>(radius * std::cos(angle) * deviations[middle]);
    const auto along = static_cast<float>(radius * std::sin(angle) * deviations[longest]);
    splats.positions.push_back(cloud.positions[i] + across * axes.col(middle) + along * axes.col(longest));
    const bool is_flat = deviations[flat] <= kFlat * deviations[middle];
    splats.normals.push_back(is_flat ? Vec3f(axes.col(flat)) : Vec3f(Vec3f::Zero()));
    splats.radii.push_back(1); // equal areas; nothing needs their size
}

} // namespace

Splats surfaceOfGaussians(const Cloud& cloud, const GaussianColumns& gaussians) {
    Splats splats;
    splats.origin = cloud.origin;
    const std::vector<OpaqueGaussian> opaque = opaqueGaussians(cloud, gaussians);
    if (opaque.empty()) return splats;
    auto at = opaque.begin();
    for (std::size_t number = 0; number < kDiscs; ++number) {
        const double area = (double(number) + 0.5) / double{kDiscs} * opaque.back().area_end;
        while (at->area_end < area && at + 1 != opaque.end()) ++at;
        addDisc(cloud, gaussians, at->index, number, splats);
    }
    return splats;
}

} // namespace pointrt
