// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/cloud_origin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pointrt {
namespace {

/// Enough to distinguish the location of a scan from no-data values at its start.
constexpr std::size_t kFirstPositions = 256;

/// Each position once, because no-data values occur in large numbers.
std::vector<Vec3d> distinct(std::vector<Vec3d> positions) {
    const auto key = [](const Vec3d& position) { return std::array{position.x(), position.y(), position.z()}; };
    std::sort(positions.begin(), positions.end(), [&](const Vec3d& a, const Vec3d& b) { return key(a) < key(b); });
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    return positions;
}

/// The upper median. Reorders the values.
double median(std::vector<double>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The median of each coordinate.
Vec3d medianOf(const std::vector<Vec3d>& positions) {
    Vec3d result;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        for (const Vec3d& position : positions) values.push_back(position[axis]);
        result[axis] = median(values);
    }
    return result;
}

} // namespace

Vec3d wholeNumbers(const Vec3d& position) {
    // Adding zero turns -0 into 0.
    return position.array().unaryExpr([](double value) { return std::trunc(value) + 0.0; });
}

void OriginChooser::add(Cloud& cloud, const Vec3d& position) {
    if (is_chosen_) return;
    first_positions_.push_back(position);
    if (first_positions_.size() == kFirstPositions) finish(cloud);
}

void OriginChooser::finish(Cloud& cloud) {
    constexpr double kFar = 1000;
    if (is_chosen_) return;
    is_chosen_ = true;
    const std::vector<Vec3d> positions = std::exchange(first_positions_, {});
    const std::vector<Vec3d> places = distinct(positions);
    const Vec3d center = medianOf(places);
    std::vector<double> distances;
    for (const Vec3d& place : places) distances.push_back((place - center).norm());
    const double spread = median(distances);
    if (spread == 0 || !((positions.front() - center).norm() > kFar * spread)) return;
    cloud.origin = wholeNumbers(center);
    for (std::size_t i = 0; i < positions.size(); ++i) cloud.positions[i] = (positions[i] - cloud.origin).cast<float>();
}

} // namespace pointrt
