// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/neighborhood.h"

#include <algorithm>

#include "preprocess/cloud/morton.h"

namespace pointrt::surface {
namespace {

/// Limit of points fetched at once: a block of points with a radius of 6 spacings has some 500 around it.
constexpr std::size_t kMostFound = 4096;

/// Limit of neighbours: within the largest radius, 6 spacings, there are pi 6^2 = 113 on one layer, and several times
/// as many where scans overlap.
constexpr std::size_t kMostKept = 192;

std::size_t roundedUp(std::size_t count) { return (count + kLaneCount - 1) / kLaneCount * kLaneCount; }

} // namespace

NeighborhoodGatherer::NeighborhoodGatherer(const PointSet& points, const std::vector<Vec3f>& places,
                                           const NearestSearch& search, const std::vector<float>& radii)
    : points_(points), places_(places), search_(search), radii_(radii), found_(kMostFound) {
    for (auto* values : {&x_, &y_, &z_, &squared_}) values->resize(kMostFound + kLaneCount);
    kept_.resize(kMostFound + 1);
    for (auto* values : {&around_.x, &around_.y, &around_.z, &around_.nx, &around_.ny, &around_.nz, &around_.weight})
        values->resize(roundedUp(kMostKept));
    around_.indices.resize(kMostKept);
}

/// Fetches the candidates of a run of points; false if there are too many and the run can be split.
bool NeighborhoodGatherer::fetchRun(std::size_t begin, std::size_t end) {
    Vec3f low = places_[begin], high = low;
    for (std::size_t i = begin; i < end; ++i) low = low.cwiseMin(places_[i]), high = high.cwiseMax(places_[i]);
    const Vec3f center = (low + high) / 2;
    float radius = 0;
    for (std::size_t i = begin; i < end; ++i)
        if (radii_[i] > 0) radius = std::max(radius, distanceBetween(center, places_[i]) + radii_[i]);
    found_count_ = radius > 0 ? search_.within(center, radius * radius, found_) : 0;
    if (found_count_ > kMostFound) {
        if (end - begin > 1) return false;
        found_count_ = kMostFound; // thousands around one point: uses those found first
    }
    for (std::size_t i = 0; i < found_count_; ++i) {
        const Vec3f& position = points_.positions[found_[i]];
        x_[i] = position.x(), y_[i] = position.y(), z_[i] = position.z();
    }
    return true;
}

void NeighborhoodGatherer::measure(const Vec3f& from) {
    for (std::size_t i = 0; i < found_count_; i += kLaneCount) {
        const Lanes dx = Eigen::Map<const Lanes>(&x_[i]) - from.x(), dy = Eigen::Map<const Lanes>(&y_[i]) - from.y(),
                    dz = Eigen::Map<const Lanes>(&z_[i]) - from.z();
        Eigen::Map<Lanes>(squared_.data() + i) = dx * dx + dy * dy + dz * dz;
    }
}

/// Writes every candidate, but advances only past those to keep: no branch to mispredict.
std::size_t NeighborhoodGatherer::keepNear(std::size_t point) {
    const float limit = radii_[point] * radii_[point];
    std::size_t count = 0;
    for (std::size_t i = 0; i < found_count_; ++i) {
        kept_[count] = std::uint32_t(i);
        count += squared_[i] < limit;
    }
    return count;
}

/// Sorts into an order that does not depend on the rest of the cloud, as every n-th point is kept: by cells of a
/// quarter of the radius, along a Morton curve, so that those are spread evenly.
void NeighborhoodGatherer::sortByCell(std::size_t point, std::size_t count) {
    const Vec3f& from = points_.positions[point];
    const float cells = 4 / radii_[point];
    order_.clear();
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t i = kept_[k];
        const auto cell = [&](float offset) { return std::uint64_t(std::clamp(offset * cells + 4, 0.0f, 7.0f)); };
        order_.push_back(
            {mortonCode(cell(x_[i] - from.x()), cell(y_[i] - from.y()), cell(z_[i] - from.z())), squared_[i], i});
    }
    std::sort(order_.begin(), order_.end());
    for (std::size_t k = 0; k < count; ++k) kept_[k] = std::get<2>(order_[k]);
}

void NeighborhoodGatherer::gather(std::size_t point) {
    measure(points_.positions[point]);
    const std::size_t near = keepNear(point);
    const Vec3f& normal = points_.normals[point];
    // not on the other sheet of something thin, nor around an edge of more than 60 degrees
    constexpr float kSameWay = 0.5f;
    std::size_t count = 0;
    for (std::size_t i = 0; i < near; ++i) {
        kept_[count] = kept_[i];
        count += points_.normals[found_[kept_[i]]].dot(normal) > kSameWay;
    }
    const std::size_t step = (count + kMostKept - 1) / kMostKept;
    if (step > 1) sortByCell(point, count);
    around_.count = 0;
    for (std::size_t i = 0; i < count; i += std::max<std::size_t>(step, 1)) around_.indices[around_.count++] = kept_[i];
    fill(point);
}

/// At first, around_.indices are indices into found_.
void NeighborhoodGatherer::fill(std::size_t point) {
    const Vec3f& from = points_.positions[point];
    const float inverse = 1 / radii_[point];
    for (std::size_t i = 0; i < around_.count; ++i) {
        const std::uint32_t place = around_.indices[i], index = found_[place];
        around_.indices[i] = index;
        around_.x[i] = (x_[place] - from.x()) * inverse;
        around_.y[i] = (y_[place] - from.y()) * inverse;
        around_.z[i] = (z_[place] - from.z()) * inverse;
        const Vec3f& normal = points_.normals[index];
        around_.nx[i] = normal.x(), around_.ny[i] = normal.y(), around_.nz[i] = normal.z();
        const float near = std::max(1 - squared_[place] * inverse * inverse, 0.0f), square = near * near;
        around_.weight[i] = square * square;
    }
    for (std::size_t i = around_.count; i < roundedUp(around_.count); ++i) {
        for (auto* values :
             {&around_.x, &around_.y, &around_.z, &around_.nx, &around_.ny, &around_.nz, &around_.weight})
            (*values)[i] = 0;
    }
}

} // namespace pointrt::surface
