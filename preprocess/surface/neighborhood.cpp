// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/neighborhood.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "preprocess/cloud/morton.h"

namespace pointrt::surface {
namespace {

/// Limit of points fetched at once: a block of points with a radius of 6 spacings has some 500 around it.
constexpr std::size_t kMostFound = 4096;

/// Keys that sort neighbours by cell, squared distance and place among those found, as one number.
constexpr int kFoundBits = std::countr_zero(kMostFound), kCellShift = kFoundBits + 32;
constexpr std::size_t kCells = 8 * 8 * 8;

/// spreadBits of the number of a cell along an axis.
constexpr std::array<std::uint64_t, 8> kSpread{spreadBits(0), spreadBits(1), spreadBits(2), spreadBits(3),
                                               spreadBits(4), spreadBits(5), spreadBits(6), spreadBits(7)};

/// Limit of neighbours: within the largest radius, 6 spacings, there are pi 6^2 = 113 on one layer, and several times
/// as many where scans overlap.
constexpr std::size_t kMostKept = 192;

std::size_t roundedUp(std::size_t count) { return (count + kLaneCount - 1) / kLaneCount * kLaneCount; }

} // namespace

NeighborhoodGatherer::NeighborhoodGatherer(const PointSet& points, const std::vector<Vec3f>& places,
                                           const NearestSearch& search, const std::vector<float>& radii)
    : points_(points), places_(places), search_(search), radii_(radii), found_(kMostFound) {
    for (auto* values : {&x_, &y_, &z_, &nx_, &ny_, &nz_, &squared_, &cosines_})
        values->resize(kMostFound + kLaneCount);
    kept_.resize(kMostFound + 1);
    for (auto* keys : {&keys_, &sorted_keys_}) keys->resize(kMostFound);
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
        const Vec3f &position = points_.positions[found_[i]], &normal = points_.normals[found_[i]];
        x_[i] = position.x(), y_[i] = position.y(), z_[i] = position.z();
        nx_[i] = normal.x(), ny_[i] = normal.y(), nz_[i] = normal.z();
    }
    return true;
}

void NeighborhoodGatherer::measure(const Vec3f& from, const Vec3f& normal) {
    const float px = from.x(), py = from.y(), pz = from.z(), mx = normal.x(), my = normal.y(), mz = normal.z();
    for (std::size_t i = 0; i < found_count_; i += kLaneCount) {
        const auto at = [i](const std::vector<float>& values) { return Eigen::Map<const Lanes>(values.data() + i); };
        const Lanes dx = at(x_) - px, dy = at(y_) - py, dz = at(z_) - pz;
        Eigen::Map<Lanes>(squared_.data() + i) = dx * dx + dy * dy + dz * dz;
        Eigen::Map<Lanes>(cosines_.data() + i) = at(nx_) * mx + (at(ny_) * my + at(nz_) * mz);
    }
}

/// Keeps those nearer than a radius that are not on the other sheet of something thin, nor around an edge of more than
/// 60 degrees. Writes every candidate, but advances only past those to keep: no branch to mispredict.
std::size_t NeighborhoodGatherer::keepNear(float squared_radius) {
    constexpr float kSameWay = 0.5f;
    const float *squared = squared_.data(), *cosines = cosines_.data();
    std::uint32_t* kept = kept_.data();
    std::size_t count = 0;
    for (std::size_t i = 0; i < found_count_; ++i) {
        kept[count] = std::uint32_t(i);
        count += std::size_t(squared[i] < squared_radius) & std::size_t(cosines[i] > kSameWay);
    }
    return count;
}

/// Sorts into an order that does not depend on the rest of the cloud, as every n-th point is kept: by cells of a
/// quarter of the radius, along a Morton curve, so that those are spread evenly; in a cell, by distance.
void NeighborhoodGatherer::sortByCell(std::size_t point, std::size_t count) {
    const Vec3f& from = points_.positions[point];
    const float cells = 4 / radii_[point];
    std::array<std::uint16_t, kCells + 1> first{};
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t i = kept_[k];
        const auto spread = [&](float offset) {
            return kSpread[std::size_t(int(std::clamp(offset * cells + 4, 0.0f, 7.0f)))];
        };
        const std::uint64_t code =
            spread(x_[i] - from.x()) | spread(y_[i] - from.y()) << 1 | spread(z_[i] - from.z()) << 2;
        keys_[k] = code << kCellShift | std::uint64_t(std::bit_cast<std::uint32_t>(squared_[i])) << kFoundBits | i;
        ++first[code + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (std::size_t k = 0; k < count; ++k) sorted_keys_[first[keys_[k] >> kCellShift]++] = keys_[k];
    for (std::size_t begin = 0, end; begin < count; begin = end) {
        end = first[sorted_keys_[begin] >> kCellShift];
        std::sort(sorted_keys_.begin() + std::ptrdiff_t(begin), sorted_keys_.begin() + std::ptrdiff_t(end));
    }
    for (std::size_t k = 0; k < count; ++k) kept_[k] = std::uint32_t(sorted_keys_[k]) & (kMostFound - 1);
}

void NeighborhoodGatherer::gather(std::size_t point) {
    measure(points_.positions[point], points_.normals[point]);
    const std::size_t count = keepNear(radii_[point] * radii_[point]), step = (count + kMostKept - 1) / kMostKept;
    if (step > 1) sortByCell(point, count);
    around_.count = 0;
    for (std::size_t i = 0; i < count; i += std::max<std::size_t>(step, 1)) around_.indices[around_.count++] = kept_[i];
    fill(point);
}

/// At first, around_.indices are indices into found_. Collects values before it computes with them, several at once.
void NeighborhoodGatherer::fill(std::size_t point) {
    const std::size_t count = around_.count, end = roundedUp(count);
    float *x = around_.x.data(), *y = around_.y.data(), *z = around_.z.data(), *nx = around_.nx.data(),
          *ny = around_.ny.data(), *nz = around_.nz.data(), *weight = around_.weight.data();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t place = around_.indices[i];
        x[i] = x_[place], y[i] = y_[place], z[i] = z_[place], weight[i] = squared_[place];
        nx[i] = nx_[place], ny[i] = ny_[place], nz[i] = nz_[place];
        around_.indices[i] = found_[place];
    }
    const Vec3f& from = points_.positions[point];
    const float inverse = 1 / radii_[point];
    for (std::size_t i = 0; i < count; i += kLaneCount) {
        Eigen::Map<Lanes> at_x(x + i), at_y(y + i), at_z(z + i), at_weight(weight + i);
        at_x = (at_x - from.x()) * inverse, at_y = (at_y - from.y()) * inverse, at_z = (at_z - from.z()) * inverse;
        const Lanes near = (1 - at_weight * inverse * inverse).max(0.0f), square = near * near;
        at_weight = square * square;
    }
    for (float* values : {x, y, z, nx, ny, nz, weight}) std::fill(values + count, values + end, 0.0f);
}

} // namespace pointrt::surface
