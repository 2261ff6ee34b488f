// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/surroundings.h"

#include <algorithm>

#include "preprocess/cloud/morton.h"

namespace pointrt::surface {
namespace {

/// What is fetched at once at most: a block of points with a reach of 6 spacings has some 500 around it.
constexpr std::size_t kMostFound = 4096;

/// More neighbours than this say no more: with the largest reach of 6 spacings there are pi 6^2 = 113 on one layer,
/// and where scans overlap several times as many.
constexpr std::size_t kMostKept = 192;

std::size_t roundedUp(std::size_t count) { return (count + kLaneCount - 1) / kLaneCount * kLaneCount; }

} // namespace

Gatherer::Gatherer(const Points& points, const std::vector<Vec3f>& places, const NearestSearch& search,
                   const std::vector<float>& reaches)
    : points_(points), places_(places), search_(search), reaches_(reaches), found_(kMostFound) {
    for (auto* values : {&x_, &y_, &z_, &squared_}) values->resize(kMostFound + kLaneCount);
    kept_.resize(kMostFound + 1);
    for (auto* values : {&around_.x, &around_.y, &around_.z, &around_.nx, &around_.ny, &around_.nz, &around_.weight})
        values->resize(roundedUp(kMostKept));
    around_.indices.resize(kMostKept);
}

/// Fetches what is within reach of the points of a run; false where that is too much, and the run can be cut.
bool Gatherer::fetchRun(std::size_t begin, std::size_t end) {
    Vec3f low = places_[begin], high = low;
    for (std::size_t i = begin; i < end; ++i) low = low.cwiseMin(places_[i]), high = high.cwiseMax(places_[i]);
    const Vec3f center = (low + high) / 2;
    float radius = 0;
    for (std::size_t i = begin; i < end; ++i)
        if (reaches_[i] > 0) radius = std::max(radius, distanceBetween(center, places_[i]) + reaches_[i]);
    found_count_ = radius > 0 ? search_.within(center, radius * radius, found_) : 0;
    if (found_count_ > kMostFound) {
        if (end - begin > 1) return false;
        found_count_ = kMostFound; // thousands within reach of one point: those met first stand for all
    }
    for (std::size_t i = 0; i < found_count_; ++i) {
        const Vec3f& position = points_.positions[found_[i]];
        x_[i] = position.x(), y_[i] = position.y(), z_[i] = position.z();
    }
    return true;
}

void Gatherer::measure(const Vec3f& from) {
    for (std::size_t i = 0; i < found_count_; i += kLaneCount) {
        const Lanes dx = Eigen::Map<const Lanes>(&x_[i]) - from.x(), dy = Eigen::Map<const Lanes>(&y_[i]) - from.y(),
                    dz = Eigen::Map<const Lanes>(&z_[i]) - from.z();
        Eigen::Map<Lanes>(squared_.data() + i) = dx * dx + dy * dy + dz * dz;
    }
}

/// Writes every candidate's place and moves on past those to keep: no branch for the processor to guess wrong.
std::size_t Gatherer::keepNear(std::size_t point) {
    const float limit = reaches_[point] * reaches_[point];
    std::size_t count = 0;
    for (std::size_t i = 0; i < found_count_; ++i) {
        kept_[count] = std::uint32_t(i);
        count += squared_[i] < limit;
    }
    return count;
}

/// In an order that is the same in whatever cloud the points are found: every so manieth of them is kept. By cells of a
/// quarter of the reach along a Morton curve, so that those are spread evenly.
void Gatherer::sortByPlace(std::size_t point, std::size_t count) {
    const Vec3f& from = points_.positions[point];
    const float cells = 4 / reaches_[point];
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

void Gatherer::gather(std::size_t point) {
    measure(points_.positions[point]);
    const std::size_t near = keepNear(point);
    const Vec3f& normal = points_.normals[point];
    // Facing the same way: not on the other sheet of something thin, nor round an edge of more than 60 degrees.
    constexpr float kSameWay = 0.5f;
    std::size_t count = 0;
    for (std::size_t i = 0; i < near; ++i) {
        kept_[count] = kept_[i];
        count += points_.normals[found_[kept_[i]]].dot(normal) > kSameWay;
    }
    const std::size_t step = (count + kMostKept - 1) / kMostKept;
    if (step > 1) sortByPlace(point, count);
    around_.count = 0;
    for (std::size_t i = 0; i < count; i += std::max<std::size_t>(step, 1)) around_.indices[around_.count++] = kept_[i];
    fill(point);
}

/// around_.indices holds places in found_ so far.
void Gatherer::fill(std::size_t point) {
    const Vec3f& from = points_.positions[point];
    const float inverse = 1 / reaches_[point];
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
